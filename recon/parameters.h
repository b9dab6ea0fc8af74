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
    bool bounds = true;         ///< pixels are limited to what their own samples allow
};

/// Constants of the stages. docs/reconstruction.md, "Ablation", shows how the errors change when some of them are
/// halved or doubled (tests/bench/ablation_bench.cpp). Constants marked "not tuned" were not measured. Distances
/// are in pixels.
struct GuidedParameters {
    GuidedStages stages;

    // Fireflies, reconstruction (56) and (57). A sample's limit is this fraction of the sum, or this factor times
    // the mean, of the others.
    float firefly_fraction = 0.125f;
    float firefly_factor = 2;
    float firefly_own = 0.5f; ///< weight of the pixel's own other samples against the mean over 3x3 pixels

    // Local mean brightness L, reconstruction (42).
    float dark = 0.2f;     ///< weight of L, which is added to every brightness that differences are divided by
    int local_radius = 32; ///< radius of the squares of L

    // Edge weights, reconstruction (38) to (40), also of the published reconstruction `weighted`.
    float edge_noise = 0.5f;   ///< factor of k in reconstruction (39)
    float alpha_scale = 0.35f; ///< alpha of weighted reconstructions relative to L2
    int gradient_radius = 1;   ///< radius of the squares over which variances of gradients are averaged
    int primal_radius = 3;     ///< radius for variances of the primal

    // Remodulation, reconstruction (46).
    float slope_prior = 0.1f; ///< weight of the prior slope, in variances of a pixel's albedo

    // Features, reconstruction (43).
    float feature_width =
        0.5f; ///< difference of albedo, normal or log depth that counts as one standard deviation
    float roughness_width = 0.2f; ///< the same for the root of the roughness
    float least_albedo = 0.02f;   ///< the smallest albedo by which radiance is divided

    // Redistribution, reconstruction (59) and (60).
    float largest_addition = 0.1f; ///< largest addition to a pixel with similar features, relative to S
    int around_radius = 6;         ///< radius of the blur that spreads the rest
    std::size_t near_levels = 2;   ///< kernel levels whose mean brightness the rest follows; not tuned
    float least_local = 1e-4f;     ///< weight of L in that brightness, for black surroundings; not tuned

    // Filter and regression, reconstruction (48) to (55).
    std::size_t levels = 4; ///< number of filter levels, each three times as wide as the last
    int noise_radius = 6;   ///< radius of the squares over which noise and differences are measured
    float square_width = 5; ///< noise variances by which the brightness of two squares may differ
    float ridge = 1e-5f;    ///< ridge of the regression, relative to the sum of weights of a square

    // Upper bounds, reconstruction (61) and (62).
    float bound_reach = 2;        ///< standard errors by which a pixel may exceed its own samples
    std::size_t bound_levels = 3; ///< kernel levels over which standard errors are averaged: wider than a tile
    float bound_lit = 0.5f;       ///< fraction of the surrounding pixels that must have found light
};

} // namespace tessera
