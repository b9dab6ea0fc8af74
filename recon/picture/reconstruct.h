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
    Norm norm = Norm::guided; ///< applied() replaces it if there are no gradients
    float alpha = 0.2f;       ///< weight of the primal against the gradients, > 0

    bool operator==(const ReconstructionSettings&) const = default;
};

struct Reconstruction {
    RgbImage image;      ///< radiance, including directly visible emission; empty: stopped
    double residual = 0; ///< relative residual of the normal equations (L2)
    int iterations = 0;  ///< inner solves, steps of weighted, or sweeps of uniform; 1 for L2, 0 without solver
    double seconds = 0;  ///< wall time
    double redistributed = 0; ///< fraction of the energy that was clamped from fireflies and redistributed, [0, 1]
    bool goes_on = false;     ///< weights of an earlier picture were reused (incremental reconstruction)
};

/// Sizes that determine the memory of a reconstruction.
struct ReconstructionSize {
    int width, height;
    bool has_gradients, is_demodulated; ///< as GradientImages are
    int components = 0;                 ///< components of the basis
    int threads = 1;
};

class PictureSolvers;
struct GuidedFit;

/// Reconstructs a sequence of pictures, and keeps data for the next: prepared transforms, scratch images, the last
/// solutions, and the weights of `guided` and `smoothed`. One call at a time.
class Reconstructor {
public:
    Reconstructor();
    ~Reconstructor();

    /// Does the same as the function reconstruct(), but starts from the last picture, which must be of the same
    /// scene and view. L1, mixed and weighted solvers start from their last solution. `guided` and `smoothed` keep
    /// their weights from the second picture on: pictures with the same settings and less than a quarter more
    /// samples (GradientImages::brightest has their number) take half of the time or less.
    Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                               const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

    /// Makes the next picture start cold.
    void forget();

    /// Sets whether weights are kept for the next picture, which takes memory between pictures.
    void set_keeps(bool keeps);

    /// Sets constants and stages, for tests and benches.
    void set_parameters(const GuidedParameters& parameters);

    /// Returns the largest number of bytes that reconstruct() allocates: for the picture, and for solvers that it
    /// does not have yet.
    std::uint64_t bytes_for(const ReconstructionSize& size, Norm norm) const;

    /// Returns the additional bytes for keeping weights.
    static std::uint64_t bytes_to_keep(int width, int height);

    /// Returns the bytes of kept weights. The next picture uses them, or frees them first.
    std::uint64_t bytes_kept() const;

private:
    struct KeptFit;
    Reconstruction denoise(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for, const SolveWatch& watch);
    Reconstruction publish(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for, const SolveWatch& watch);

    std::unique_ptr<PictureSolvers> solvers_; ///< for the size of the last picture
    std::unique_ptr<KeptFit> kept_;           ///< fit of an earlier picture; null: none
    GuidedParameters parameters_;
    bool keeps_ = true;
    bool has_solved_ = false; ///< there is a picture of the same scene and view
};

/// Reconstructs a picture from means of samples and adds directly visible emission. Throws std::invalid_argument
/// if the images differ in size, features or half differences are incomplete, or alpha is not above 0.
Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

} // namespace tessera
