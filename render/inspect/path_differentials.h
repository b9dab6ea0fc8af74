#pragma once

#include "render/scene/camera.h"

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

struct BasePath;
struct Tracer;

/// The neighbourhood of a base path, without tracing any other: partial derivatives of its vertices by all random
/// numbers that it was made of [Suykens 2001]. Each is uniform in [0, 1]: the first two say where in its pixel a
/// path begins, and two more at every vertex in which direction it goes on by a lobe; delta scatters draw none.
struct PathDifferentials {
    struct Vertex {
        glm::vec3 normal; ///< geometric, unit: derivatives lie in that plane
        /// By the numbers drawn up to here: units of the scene. Those drawn later do not move it.
        std::vector<glm::vec3> position;
        /// Relative derivatives of what the vertices before it do to light, f cos along the path, by the same
        /// numbers [Suykens 2001, 4.2]; by the luminance.
        std::vector<float> gradient;
        double survival; ///< probability that roulette on path length let the path come here

        // For the scalar form.
        float distance;      ///< from the vertex before, or the camera
        float cosine;        ///< to the normal, absolute
        float cosine_before; ///< of the same way to the normal of the vertex before; 1: there is none
        float kept_angle; ///< share of the angle before that a scatter keeps: 1 of a mirror's, none of a diffuse
                          ///< one's
        float scatter_angle; ///< root of 1 / pdf_w with which it was sent here, radians; 0: the camera, or a delta
    };
    std::vector<Vertex> vertices;
    PixelWidth pixel;
};

/// Of a path through a point of the picture and of the lens. Where lobes are chosen by chance, and alpha and
/// opacity are looked up in textures, choices stay as they are. A path whose ray comes to another end when it is
/// traced again is followed as far as it does not.
PathDifferentials differentiate(const Tracer& tracer, const Projection& projection, glm::vec2 pixel,
                                glm::vec2 lens, const BasePath& path);

/// How large a part of [0, 1] one path stands for in each of its numbers [Suykens 2001, 3.4 and 4.3].
struct DeltaRule {
    double samples = 1; ///< a pixel
    /// All samples are evenly spread over all numbers: (samples * survival) ^ (-1 / numbers) for each. Otherwise
    /// 1 / sqrt(samples) for the pixel, and 1 for each scatter, as no path splits.
    bool is_global = true;
    /// FR_max: a path's light may change by this share at the most within it; 0: it may by any.
    float most_change = 0;
    static constexpr float published_change = 0.7f;
};

/// The part of a surface that a path stands for: the parallelogram of two vectors about the vertex that covers
/// about what all differential vectors together reach.
struct Footprint {
    glm::vec3 a{0}, b{0}; ///< units of the scene; 0 0: a point
    float area() const;
};

/// How far vertex i, counted from 0, goes within the part of each number that the path stands for: units of the
/// scene.
std::vector<glm::vec3> differential_vectors(const PathDifferentials& path, int i, const DeltaRule& rule);

/// Of vertex i.
Footprint footprint(const PathDifferentials& path, int i, const DeltaRule& rule);

/// The Minkowski sum of segments, the sides of a polygon: reduced to two vectors [Suykens 2001, 3.5].
Footprint reduce(const std::vector<glm::vec3>& segments, glm::vec3 normal);
/// The area of that polygon.
float area_of_sum(const std::vector<glm::vec3>& segments, glm::vec3 normal);

/// The same area by two numbers a vertex, the width of a square and the angle by which it grows: from pixel angle,
/// distances, cosines and densities alone, for flat surfaces. No gradient.
float scalar_area(const PathDifferentials& path, int i, const DeltaRule& rule);

} // namespace tessera
