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

/// What the judge measured.
struct NaiveMeasured {
    Measured light; ///< all but very direct light
    Measured very_direct;
    Measured coefficient; ///< light over the albedo of what is seen first, straight or in mirrors
};

/// The judge: a path tracer without emitter sampling and without weights, with random numbers of its own; light is
/// counted only where a path runs into it, but for lights that no ray can meet: of these all are summed at every
/// vertex. Nothing of the estimators under test is in it but vertices and BSDFs. Very direct
/// is what the camera sees itself.
NaiveMeasured render_naive(const Scene& scene, glm::ivec2 size, int max_depth, int samples, std::uint32_t seed);

/// Light by how it left what the camera sees first.
struct ByDirection {
    glm::vec3 direction{0, 0, 1}; ///< unit, world
    Rgb f_cos{0};                 ///< infinite: a delta scatter
    Rgb carried{0};               ///< toward the camera
};
/// What the light of one sample of a pixel is in parts.
using ComponentsOf = std::function<void(glm::ivec2 pixel, Rgb albedo, std::span<const ByDirection> light,
                                        std::span<Rgb> components)>;

/// The means of such parts, by the same judge, of a camera without a lens.
std::vector<Measured> render_naive_components(const Scene& scene, glm::ivec2 size, int max_depth, int samples,
                                              std::uint32_t seed, int components,
                                              const ComponentsOf& components_of);

} // namespace tessera::test
