#pragma once

#include "recon/image.h"
#include "render/scene/scene.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera::test {

/// Means and their standard errors, per pixel and channel.
struct Measured {
    RgbImage mean;
    RgbImage standard_error;
};

/// Images of render_naive().
struct NaiveMeasured {
    Measured light;       ///< radiance without directly visible emission
    Measured very_direct; ///< directly visible emission, also in mirrors
    Measured coefficient; ///< `light` over the albedo of the first surface that is no mirror
};

/// Renders with a naive path tracer: independent random numbers, no MIS weights, and emission only where a path
/// hits it. Lights without extent are summed at every vertex. It shares only vertices, BSDFs and lights with the
/// estimators under test.
NaiveMeasured render_naive(const Scene& scene, glm::ivec2 size, int max_depth, int samples, std::uint32_t seed);

/// Radiance by the direction in which it arrives at x_1.
struct ByDirection {
    glm::vec3 direction{0, 0, 1}; ///< unit, world
    Rgb f_cos{0};                 ///< at x_1; infinite after a delta scatter
    Rgb carried{0};               ///< radiance toward the camera
};
/// Computes the basis components of one sample of a pixel.
using ComponentsOf = std::function<void(glm::ivec2 pixel, Rgb albedo, std::span<const ByDirection> light,
                                        std::span<Rgb> components)>;

/// Renders the means of such components with the same path tracer. The camera has no lens.
std::vector<Measured> render_naive_components(const Scene& scene, glm::ivec2 size, int max_depth, int samples,
                                              std::uint32_t seed, int components,
                                              const ComponentsOf& components_of);

} // namespace tessera::test
