#pragma once

#include "render/paths/base_path.h"
#include "render/inspect/differentiation.h"
#include "render/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// At vertex i of a path that goes on from there.
Scattering scattering_of(const BasePath& path, int i);

/// The neighbourhood of a base path, without tracing any other [Suykens 2001]: calls visit(i, derivatives) for its
/// vertices, 0 the first. Of a path through a point of the picture and of the lens. Where lobes are chosen by
/// chance, and alpha and opacity are looked up in textures, choices stay as they are.
/// @param hits   what the path's rays met (Tracer::hits)
/// @param along  is used
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

/// Returns the derivatives of the light sample of vertex i of a path. The sample lies on a surface and brings
/// light. Only its own two random numbers move it. The gradient is that of f cos at the vertex, and of cosine and
/// squared distance at the light.
PathDerivatives differentiate_light(const Tracer& tracer, const BasePath& path, int i,
                                    const PathDerivatives& vertex);

/// How large a part of [0, 1] one path stands for in each of its numbers [Suykens 2001, 3.4 and 4.3].
struct DeltaRule {
    float samples = 1; ///< a pixel
    /// All samples are evenly spread over all numbers: (samples * chance) ^ (-1 / numbers) for each. Otherwise
    /// 1 / sqrt(samples) for the pixel, and for each scatter 1 / sqrt(splits), more after choices of less chance.
    bool is_global = true;
    /// FR_max: a path's light may change by this share at the most within it; 0: it may by any.
    float most_change = 0;
    float splits = 1; ///< ways that each scatter goes on in; not for global ones
    static constexpr float published_change = 0.7f;
};

/// The part of a surface that a path stands for: the parallelogram of two vectors about the vertex that covers
/// about what all differential vectors together reach.
struct Footprint {
    glm::vec3 a{0}, b{0}; ///< units of the scene; 0 0: a point
    float area() const;
};

/// How far the point goes within the part of each number that the path stands for: units of the scene.
NumberVectors differential_vectors(const PathDerivatives& point, const DeltaRule& rule);

/// Of the point.
Footprint footprint(const PathDerivatives& point, const DeltaRule& rule);

/// The Minkowski sum of segments, the sides of a polygon: reduced to two vectors [Suykens 2001, 3.5].
Footprint reduce(const NumberVectors& segments, int count, glm::vec3 normal);
/// The area of that polygon.
float area_of_sum(const NumberVectors& segments, int count, glm::vec3 normal);

/// About as large a footprint by two floats a vertex, the width of a square and the angle by which it grows: from
/// pixel angle, distances, cosines and densities alone, for flat surfaces. No gradient; deltas are global.
class ScalarFootprint {
public:
    /// Of a camera ray.
    explicit ScalarFootprint(PixelWidth pixel) : width_(pixel.least), angle_(pixel.angle) {}

    /// @param cosine  between the ray and the normal where it arrives, absolute
    void arrive(float distance, float cosine) {
        // Squares of the same area: across the way from the vertex before, and on the surface.
        width_ = (width_ * std::sqrt(cosine_) + angle_ * distance) / std::sqrt(cosine);
    }
    /// @param cosine     between the next ray and the normal, absolute
    /// @param roughness  the share of the angle so far that is forgotten: none of a mirror's, all of a diffuse
    ///                   surface's; of a delta scatter it and pdf_w do not count
    void scatter(float cosine, bool is_delta, float roughness, float pdf_w, float survival) {
        cosine_ = cosine;
        log_chance_ += survival < 1 ? std::log2(survival) : 0;
        if (is_delta)
            return;
        angle_ = (1 - std::min(roughness, 1.0f)) * angle_ + std::sqrt(1 / pdf_w);
        numbers_ += 2;
    }

    /// On the surface, of one of so many samples: units of the scene.
    /// @param log_samples  to the base 2
    float width(float log_samples) const { return width_ * std::exp2(-(log_samples + log_chance_) / numbers_); }

private:
    // As if each number's whole interval were the path's.
    float width_, angle_;
    float cosine_ = 1, log_chance_ = 0, numbers_ = 2;
};

/// Of x_1, x_2, ... of a path: widths, units of the scene.
/// @param pixel   of the camera ray's picture
/// @param origin  of that ray
/// @param log_samples  a pixel, to the base 2
void scalar_footprints(const BasePath& path, PixelWidth pixel, glm::vec3 origin, float log_samples,
                       std::vector<float>& widths);

} // namespace tessera
