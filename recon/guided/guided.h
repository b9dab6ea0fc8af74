#pragma once

#include "recon/guided/feature_kernels.h"
#include "recon/guided/fireflies.h"
#include "recon/guided/joint_filter.h"
#include "recon/guided/redistribution.h"
#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/parameters.h"
#include "recon/solvers/poisson_weighted.h"

#include <cstdint>
#include <optional>

namespace tessera {

class PictureSolvers;

// Tessera's denoiser, reconstruction (41) to (62): `guided` for methods with gradients, `smoothed` for the primal
// alone. Its stages:
//   1 fireflies       clamps the brightest sample of each pixel                      (fireflies.h)
//   2 edge weights    weights gradients by their variances; guided only              (edge_weights.h)
//   3 solve           weighted screened Poisson, of the picture and of its noise; guided only (poisson_weighted.h)
//   4 remodulation    multiplies by the albedo, with its covariance                  (demodulation.h)
//   5 redistribution  returns the energy clamped by stage 1                          (redistribution.h)
//   6 filter          cross-bilateral filter at several scales                       (joint_filter.h)
//   7 regression      fits radiance to features, against the noise of edges          (feature_regression.h)
//   8 bounds          limits pixels to what their own samples allow                  (upper_bounds.h)
// Stages 6 and 7 need features and half differences, stage 8 needs variances of pixels that share their paths.
// Without these they are left out.

/// Data of the stages that hardly change from one picture to the next, such as kernels and weights. A picture of
/// nearly the same samples takes half of the time or less with it (incremental reconstruction).
struct GuidedFit {
    std::optional<FeatureKernels> kernels;
    EdgeWeights weights;
    Image<float> local; ///< L of reconstruction (42)
    NearbyBrightness nearby;
    FilterFit filter;

    std::uint64_t bytes() const;
    /// Upper limit, without the kernels.
    static constexpr std::uint64_t bytes_a_pixel = FilterFit::bytes_a_pixel + 5 * sizeof(float);
};

/// Result of the stages, without directly visible emission. An empty image: stopped.
struct GuidedPicture {
    RgbImage image;
    double redistributed = 0; ///< fraction of the raw radiance's energy that was clamped and redistributed
    int iterations = 0;       ///< steps of the solver
};

/// Runs the stages on one picture. The member functions are called in the order of the stages.
class Guided {
public:
    /// Keeps references to all arguments.
    /// @param alpha    weight of the primal; 0: `smoothed`, which has no solver
    /// @param fit      filled, or used if `is_fitted`
    Guided(const GradientImages& raw, float alpha, const GuidedParameters& parameters, PictureSolvers& solvers,
           GuidedFit& fit, bool is_fitted, const ParallelFor& parallel_for, const SolveWatch& watch)
        : raw_(raw), alpha_(alpha), parameters_(parameters), solvers_(solvers), fit_(fit), is_fitted_(is_fitted),
          parallel_for_(parallel_for), watch_(watch) {}

    GuidedPicture picture();

private:
    bool solves() const { return alpha_ > 0; }
    bool can_filter() const { return !raw_.features.empty() && !raw_.halves.empty(); }
    const GradientImages& images() const { return clamped_.clamped.empty() ? raw_ : clamped_.images; }

    void clamp_samples();
    void find_features();
    RgbImage solve();
    void remodulate(RgbImage& picture) const;
    void redistribute(RgbImage& picture);
    RgbImage noise();
    void filter(RgbImage& picture);
    void limit(RgbImage& picture) const;
    void finish(RgbImage& picture) const;

    const GradientImages& raw_;
    float alpha_;
    const GuidedParameters& parameters_;
    PictureSolvers& solvers_;
    GuidedFit& fit_;
    bool is_fitted_;
    const ParallelFor& parallel_for_;
    const SolveWatch& watch_;

    ClampedSamples clamped_; ///< empty if fireflies cannot be clamped
    int iterations_ = 0;
};

/// Returns the bytes that a picture takes without its samples, its solvers and a fit.
std::uint64_t bytes_for_guided(int width, int height, bool has_gradients, bool is_demodulated);

} // namespace tessera
