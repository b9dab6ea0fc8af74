#pragma once

#include "recon/image.h"
#include "render/scene/scene.h"

#include <cstdint>

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
    Measured coefficient; ///< light over the albedo of what is seen first
};

/// The judge: a path tracer without emitter sampling and without weights, with random numbers of its own; light is
/// counted only where a path runs into it, but for lights that no ray can meet: of these all are summed at every
/// vertex. Nothing of the estimators under test is in it but vertices and BSDFs. Very direct
/// is what the camera sees itself.
NaiveMeasured render_naive(const Scene& scene, glm::ivec2 size, int max_depth, int samples, std::uint32_t seed);

} // namespace tessera::test
