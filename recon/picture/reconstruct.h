#pragma once

#include "recon/image.h"
#include "recon/norm.h"
#include "recon/parallel.h"
#include "recon/parameters.h"
#include "recon/solvers/poisson_problem.h"

#include <cstdint>
#include <memory>

namespace tessera {

struct ReconstructionSettings {
    Norm norm = Norm::guided; ///< as applied(): without gradients, the raw primal
    float alpha = 0.2f;       ///< weight of the primal image against its gradients, > 0

    bool operator==(const ReconstructionSettings&) const = default;
};

struct Reconstruction {
    RgbImage image;      ///< radiance, directly visible emission included; empty when stopped
    double residual = 0; ///< relative residual of the normal equations (L2)
    int iterations = 0;  ///< inner solves, steps of weighted, or sweeps of uniform; 1 for L2, 0 without solver
    double seconds = 0;  ///< wall time
    double redistributed = 0; ///< fraction of the energy that was clamped from fireflies and redistributed
    bool goes_on = false;     ///< it was made with what was found about an earlier picture (incremental)
};

/// What the memory of a reconstruction depends on.
struct ReconstructionSize {
    int width, height;
    bool has_gradients, is_demodulated; ///< as GradientImages are
    int parts = 0;                      ///< components of the basis
    int threads = 1;
};

class PictureSolvers;
struct GuidedFit;

/// Reconstructs one picture after the other, and keeps what the next can use: prepared transforms, memory, the
/// last solutions, and what `guided` and `smoothed` found about the picture. One call at a time.
class Reconstructor {
public:
    Reconstructor();
    ~Reconstructor();

    /// Makes the picture that the function reconstruct() makes, but starts from the last one, which must be of the
    /// same scene and view. L1, mixed and weighted solvers start from their last solution. `guided` and `smoothed`
    /// keep what they find from the second picture on: pictures with the same settings and less than a quarter
    /// more samples (GradientImages::brightest says how many) take half of the time or less.
    Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                               const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

    /// The next picture starts from nothing.
    void forget();

    /// Whether what was found is kept, which takes memory from one picture to the next.
    void set_keeps(bool keeps);

    /// Other constants and stages, for tests and benches.
    void set_parameters(const GuidedParameters& parameters);

    /// The most bytes that reconstruct() takes beside its images: for the picture, and for solvers that it does
    /// not have yet.
    std::uint64_t bytes_for(const ReconstructionSize& size, Norm norm) const;

    /// Bytes that it takes beside these to keep what it finds.
    static std::uint64_t bytes_to_keep(int width, int height);

    /// Bytes of what it has kept: the next picture uses it, or frees it before anything else.
    std::uint64_t bytes_kept() const;

private:
    struct KeptFit;
    Reconstruction denoise(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for, const SolveWatch& watch);
    Reconstruction publish(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for, const SolveWatch& watch);

    std::unique_ptr<PictureSolvers> solvers_; ///< for the size of the last picture
    std::unique_ptr<KeptFit> kept_;           ///< of an earlier picture; null: there is none
    GuidedParameters parameters_;
    bool keeps_ = true;
    bool has_solved_ = false; ///< a picture of the same scene and view
};

/// The picture that the settings make of raw primal, gradients and features, plus directly visible emission.
/// Throws std::invalid_argument where images differ in size or alpha is not above 0.
Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

} // namespace tessera
