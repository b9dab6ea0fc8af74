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

// Cross-bilateral filter at several scales, and a regression on features: what a solver leaves is smoothed over
// pixels with similar features, as far as it is noise. The measure of noise is the half difference of two halves
// of the samples (HalfDifferences), which has gone through the same solver and goes through the same filter, so
// that it shows what is left of the noise at every scale, however correlated it is within tiles.
//
// Level l + 1 of the picture is level l, filtered by kernels of 9 pixels, those of 5x5 in the row and the column
// of the middle one, 3^l apart [the a trous filter of Dammertz 2010; there 25 pixels, 2^l apart]. Weights fall
// with the distance of features, and with that of brightness relative to the noise of that level [as in Schied
// 2017]. The result is the last level plus the differences between levels, each times its trust
// (recon/guided/shrinkage.h). Then comes a regression on features (recon/guided/feature_regression.h), which
// removes the noise at edges, and the difference to it times its trust. Noise vanishes as samples grow and trust
// goes to 1: the filter is consistent. It is not linear in the samples.

/// What the filter finds about a picture and its noise: a picture of nearly the same samples can be filtered with
/// it, and needs no noise. Empty: nothing was found.
struct FilterFit {
    static constexpr std::size_t most_levels = FeatureKernels::steps.size();

    std::array<StraightWeights, most_levels> weights;
    std::array<Plane, most_levels> trust;
    Plane regression_trust; ///< empty: there was no regression

    static constexpr std::size_t bytes_a_pixel =
        most_levels * (straight_pairs * sizeof(PairWeight) + sizeof(float)) + sizeof(float);
    bool empty() const { return trust[0].empty(); }
};

/// Filters radiance without directly visible emission, as light over the albedo of the features. Energy is not
/// exactly kept. A picture that is not finite stays what it is. The same bits for any parallel_for.
/// @param picture  with its noise: fills `fit`; without: uses it
/// @param local    local_mean_brightness() of the light
/// @returns what is left of picture and noise; empty: stopped
NoisyPicture filter(NoisyPicture picture, const FeatureImages& features, const FeatureKernels& kernels,
                    const Image<float>& local, const GuidedParameters& parameters, FilterFit& fit,
                    const ParallelFor& parallel_for, const SolveWatch& watch = {});

/// Bytes that filter() takes beside its arguments and the fit.
std::uint64_t bytes_to_filter(int width, int height);

} // namespace tessera
