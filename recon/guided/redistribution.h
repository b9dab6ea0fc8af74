#pragma once

#include "recon/guided/feature_kernels.h"
#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/parameters.h"

#include <cstddef>

namespace tessera {

// Redistribution of the energy that was clamped from fireflies (recon/guided/fireflies.h): it is known to exist,
// and not where. With a symmetric kernel K and a brightness S that the energy follows, H becomes
//     S K(H / K(S)) ,
// which has the sum of H: pixel q gives to p the fraction S(p) K(p, q) / (sum over p' of S(p') K(p', q)).

/// The sum of |radiance| over all pixels.
double sum_of_sizes(const RgbImage& radiance, const ParallelFor& parallel_for);

/// Where energy goes that similar pixels do not take: the brightness it follows, and its mean around.
struct NearbyBrightness {
    Plane brightness, around;
    bool empty() const { return brightness.empty(); }
};

/// Adds `energy` to the picture, first over pixels with similar features, by their brightness and albedo, up to
/// most_added of it; the rest to the pixels nearby, whatever their features, by the brightness of pixels similar
/// to each. The sum over the picture is kept, but for rounding.
/// @param local    local_mean_brightness() of the light, > 0
/// @param picture  radiance without directly visible emission
/// @returns where the rest went
NearbyBrightness redistribute(RgbImage energy, const FeatureKernels& kernels, const FeatureImages& features,
                              const Image<float>& local, const GuidedParameters& parameters,
                              const ParallelFor& parallel_for, RgbImage& picture);

/// Adds energy to the pixels nearby as the last step of redistribute() does.
void spread_around(const RgbImage& energy, const NearbyBrightness& nearby, const GuidedParameters& parameters,
                   const ParallelFor& parallel_for, RgbImage& picture);

/// Bytes a pixel that redistribute() takes beside its arguments.
inline constexpr std::size_t bytes_to_redistribute = 15 * sizeof(float);

} // namespace tessera
