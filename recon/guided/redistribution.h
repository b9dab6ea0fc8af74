#pragma once

#include "recon/guided/feature_kernels.h"
#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/parameters.h"

#include <cstddef>

namespace tessera {

// Redistribution of the energy H that is clamped from fireflies (recon/guided/fireflies.h), reconstruction (59).
// The energy is known to exist, and not where. With a symmetric kernel K and a brightness S that the energy
// follows, H becomes
//     S K(H / K(S)) ,
// which has the same sum: pixel q gives to p the fraction S(p) K(p, q) / (sum over p' of S(p') K(p', q)).

/// Returns the sum of |radiance| over all pixels.
double sum_of_sizes(const RgbImage& radiance, const ParallelFor& parallel_for);

/// The brightness S that energy follows to the pixels nearby, and its blurred mean K(S).
struct NearbyBrightness {
    Plane brightness, around;
    bool empty() const { return brightness.empty(); }
};

/// Adds `energy` to the picture. First it goes to pixels with similar features, by their brightness and albedo,
/// reconstruction (60), up to largest_addition of S. The rest goes to the pixels nearby, whatever their features,
/// by the mean brightness of the pixels similar to each. The sum over the picture is kept up to rounding.
/// @param local    L of reconstruction (42), > 0
/// @param picture  radiance without directly visible emission
/// @returns the brightness that the rest followed
NearbyBrightness redistribute(RgbImage energy, const FeatureKernels& kernels, const FeatureImages& features,
                              const Image<float>& local, const GuidedParameters& parameters,
                              const ParallelFor& parallel_for, RgbImage& picture);

/// Adds energy to the pixels nearby, as the last step of redistribute() does.
void spread_around(const RgbImage& energy, const NearbyBrightness& nearby, const GuidedParameters& parameters,
                   const ParallelFor& parallel_for, RgbImage& picture);

/// Bytes a pixel that redistribute() takes without its arguments.
inline constexpr std::size_t bytes_to_redistribute = 15 * sizeof(float);

} // namespace tessera
