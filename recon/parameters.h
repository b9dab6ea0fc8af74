// The stages and the constants of `guided` and `smoothed` (recon/guided/guided.h).
#pragma once

#include <cstddef>

namespace tessera {

/// The stages that a test or a bench can switch off.
struct GuidedStages {
    bool fireflies = true;      ///< fireflies are clamped
    bool edge_weights = true;   ///< gradients are weighted by their variances; off: all weights are 1
    bool covariance = true;     ///< remodulation adds the covariance of albedo and light within a pixel
    bool redistribution = true; ///< clamped energy is redistributed; off: it is lost
    bool filter = true;         ///< cross-bilateral filter
    bool regression = true;     ///< regression on features
};

/// All constants. METHODS.md, "Ablation", has a row for each: the change of the errors when it is halved and when
/// it is doubled, as tests/bench/ablation_bench.cpp prints them. Those that are marked so are not tuned. Distances
/// are in pixels.
struct GuidedParameters {
    GuidedStages stages;

    // Fireflies: a sample may be so large a fraction of all other samples, or so many times their mean.
    float firefly_fraction = 0.125f;
    float firefly_factor = 2;
    float firefly_own = 0.5f; ///< weight of the other samples of the pixel alone against those of 3x3 pixels

    // Local mean brightness, the unit of what is dark.
    float dark = 0.2f; ///< weight of the local mean that is added to every brightness that errors are relative to
    int local_radius = 32; ///< of its squares

    // Edge weights, also those of the published reconstruction `weighted`.
    float edge_noise = 0.5f;   ///< k of weights_of_gradients()
    float alpha_scale = 0.35f; ///< alpha of weighted reconstructions over that of L2
    int gradient_radius = 1;   ///< of the squares over which variances of gradients are averaged
    int primal_radius = 3;     ///< and those of the primal

    // Covariance of albedo and light.
    float slope_prior = 0.1f; ///< weight of the slope expected, in variances of a pixel's albedo

    // Features.
    float feature_width =
        0.5f; ///< difference of albedo, normal or log depth that counts as one standard deviation
    float roughness_width = 0.2f; ///< likewise, of the root of the roughness
    float least_albedo = 0.02f;   ///< the smallest albedo by which radiance is divided

    // Redistribution.
    float most_added = 0.1f;     ///< of a pixel's brightness, that similar pixels add; the rest goes around
    int around_radius = 6;       ///< of the blur that takes the rest around
    std::size_t near_levels = 2; ///< of the kernels whose mean brightness the rest follows; not tuned
    float least_local = 1e-4f;   ///< of the local mean, that the rest follows where all is black; not tuned

    // Filter and regression.
    std::size_t levels = 4; ///< of kernels, each three times as wide as the last
    int noise_radius = 6;   ///< of the squares over which noise and differences are measured
    float square_width = 5; ///< variances of noise by which the brightness of two squares may differ
    float ridge = 1e-5f;    ///< draws slopes of the regression to 0, relative to the weights of a square
};

} // namespace tessera
