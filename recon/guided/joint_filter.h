#pragma once

#include "recon/guided/feature_kernels.h"
#include "recon/guided/planes.h"
#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/parameters.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tessera {

// Cross-bilateral filter at several scales, and a regression on features. They smooth the picture over pixels with
// similar features, as far as it is noise. The half differences N measure the noise. They pass through the same
// solver and the same filter, so that they show the remaining noise at every scale, with its correlation within
// tiles.
//
// Level l + 1 is level l filtered by kernels of 9 pixels, in the row and the column of the centre, 3^l apart,
// reconstruction (48) to (50) [Dammertz 2010 has 25 pixels, 2^l apart]. Weights fall with the distance of
// features, and with that of brightness relative to the noise of the level [Schied 2017]. The result is the last
// level plus the differences between levels, each times its trust, reconstruction (51) and (52)
// (recon/guided/shrinkage.h). A regression on features (recon/guided/feature_regression.h) then removes noise at
// edges, with a trust as well, reconstruction (55). As samples grow, N goes to 0 and trust to 1: the filter is
// consistent. It is not linear in the samples.

/// Weights and trust that the filter finds from a picture and its noise. With them, a picture of nearly the same
/// samples is filtered without its noise. Empty: not found yet.
struct FilterFit {
    static constexpr std::size_t most_levels = FeatureKernels::steps.size();

    std::array<StraightWeights, most_levels> weights;
    std::array<Plane, most_levels> trust;
    Plane regression_trust; ///< empty: the stage was off

    static constexpr std::size_t bytes_a_pixel =
        most_levels * (straight_pairs * sizeof(PairWeight) + sizeof(float)) + sizeof(float);
    bool empty() const { return trust[0].empty(); }
};

/// Filters radiance without directly visible emission, divided by the albedo of the features. The energy is not
/// kept exactly. Returns a picture with values that are not finite or above 1e28 unchanged. The result has the
/// same bits for any parallel_for.
/// @param picture  with noise: fills `fit`; without: uses `fit`
/// @param local    L of reconstruction (42)
/// @returns the filtered picture and noise; empty: stopped
NoisyPicture filter(NoisyPicture picture, const FeatureImages& features, const FeatureKernels& kernels,
                    const Image<float>& local, const GuidedParameters& parameters, FilterFit& fit,
                    const ParallelFor& parallel_for, const SolveWatch& watch = {});

/// Returns the bytes that filter() takes without its arguments and the fit.
std::uint64_t bytes_to_filter(int width, int height);

} // namespace tessera
