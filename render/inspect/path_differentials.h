#pragma once

#include "render/inspect/differentiation.h"
#include "render/paths/base_path.h"
#include "render/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Returns the scatter at vertex i of a path, which must have a next vertex.
Scattering scattering_of(const BasePath& path, int i);

/// Computes path differentials of a base path without tracing other paths [Suykens 2001]. Calls visit(i,
/// derivatives) for its vertices, from 0. Random choices, among lobes and by opacity, count as fixed.
/// @param pixel  point of the picture, in pixels
/// @param lens   point of the lens (CameraSample::lens)
/// @param hits   hits of the path's rays (Tracer::hits)
/// @param along  working memory
template <class Visit>
void differentiate(const Scene& scene, const Projection& projection, glm::vec2 pixel, glm::vec2 lens,
                   const BasePath& path, std::span<const Hit> hits, Differentiation& along, Visit&& visit) {
    along.start(projection, pixel, lens);
    Ray ray = projection.ray(pixel, lens);
    for (int i = 0; i < path.size(); ++i) {
        const Vertex& x = path[i].vertex;
        const Hit& hit = hits[i];
        along.arrive(ray, hit.distance, x.geometric_normal);
        visit(i, along.derivatives());
        if (i + 1 == path.size())
            break;
        along.scatter(scene, ray, hit, x, scattering_of(path, i));
        const glm::vec3 direction = x.to_world(path[i].to_next);
        ray = {scene.intersector().off_surface(x.position, x.geometric_normal, direction), direction};
    }
}

/// Returns the derivatives of the light sample of vertex i of a path. The sample must lie on a surface and
/// contribute. Only its own two random numbers move it. The gradient is that of f cos at the vertex, and of cosine
/// and squared distance at the light.
/// @param vertex  derivatives of vertex i
PathDerivatives differentiate_light(const Tracer& tracer, const BasePath& path, int i,
                                    const PathDerivatives& vertex);

/// Rule for the deltas: the length of the interval in [0, 1] that one path represents in each of its random
/// numbers [Suykens 2001, 3.4 and 4.3].
struct DeltaRule {
    float samples = 1; ///< per pixel
    /// True: all deltas are (samples * chance)^(-1 / numbers). False: they are 1 / sqrt(samples) for the pixel's
    /// numbers and 1 / sqrt(splits * choice) for those of a scatter.
    bool is_global = true;
    /// FR_max, the largest relative change of the path's light within a delta; 0: no limit.
    float most_change = 0;
    float splits = 1; ///< branching factor of each scatter; local deltas only
    static constexpr float published_change = 0.7f;
};

/// Region of a surface that a path represents: a parallelogram around the vertex, which approximates the Minkowski
/// sum of all differential vectors.
struct Footprint {
    glm::vec3 a{0}, b{0}; ///< sides, scene units; both 0: a point
    float area() const;
};

/// Returns the differential vectors: the point's motion within the delta of each number, in scene units.
NumberVectors differential_vectors(const PathDerivatives& point, const DeltaRule& rule);

/// Returns the footprint of a point.
Footprint footprint(const PathDerivatives& point, const DeltaRule& rule);

/// Reduces the Minkowski sum of segments in a plane, a polygon, to a parallelogram [Suykens 2001, 3.5].
Footprint reduce(const NumberVectors& segments, int count, glm::vec3 normal);
/// Returns the area of that polygon.
float area_of_sum(const NumberVectors& segments, int count, glm::vec3 normal);

/// Approximates a footprint by the width of a square and the angle by which it grows, theory (25) and (26). It
/// uses the pixel's angle, distances, cosines and pdfs only, and assumes flat surfaces. It has no gradient; deltas
/// are global.
class ScalarFootprint {
public:
    /// Starts with a camera ray.
    explicit ScalarFootprint(PixelWidth pixel) : width_(pixel.least), angle_(pixel.angle) {}

    /// Transfers the footprint to the next vertex, theory (25).
    /// @param cosine  absolute cosine between the ray and the normal at that vertex
    void arrive(float distance, float cosine) {
        width_ = (width_ * std::sqrt(cosine_) + angle_ * distance) / std::sqrt(cosine);
    }
    /// Scatters at the vertex, theory (26).
    /// @param cosine     absolute cosine between the next ray and the normal
    /// @param roughness  alpha; ignored for a delta scatter, as is pdf_w
    void scatter(float cosine, bool is_delta, float roughness, float pdf_w, float survival) {
        cosine_ = cosine;
        log_chance_ += survival < 1 ? std::log2(survival) : 0;
        if (is_delta)
            return;
        angle_ = (1 - std::min(roughness, 1.0f)) * angle_ + std::sqrt(1 / pdf_w);
        numbers_ += 2;
    }

    /// Returns the width on the surface, in scene units.
    /// @param log_samples  base-2 logarithm of the samples per pixel
    float width(float log_samples) const { return width_ * std::exp2(-(log_samples + log_chance_) / numbers_); }

private:
    float width_, angle_; // for deltas of 1
    float cosine_ = 1, log_chance_ = 0, numbers_ = 2;
};

/// Computes the scalar footprints at x_1, x_2, ... of a path.
/// @param pixel        of the camera
/// @param origin       of the camera ray
/// @param log_samples  base-2 logarithm of the samples per pixel
/// @param widths       receives one width per vertex, in scene units
void scalar_footprints(const BasePath& path, PixelWidth pixel, glm::vec3 origin, float log_samples,
                       std::vector<float>& widths);

} // namespace tessera
