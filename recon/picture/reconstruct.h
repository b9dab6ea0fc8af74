#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/picture/norm.h"
#include "recon/poisson_problem.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

namespace tessera {

class AlikePixels;

struct ReconstructionSettings {
    Norm norm = Norm::guided;
    float alpha = 0.2f;       ///< weight of the primal image against its gradients, > 0
    bool joint_colour = true; ///< L1 and mixed: lengths of colours, not absolute values of each channel
    Spikes spikes = Spikes::consistent;

    bool operator==(const ReconstructionSettings&) const = default;
};

/// Whether single samples are held back (recon/picture/spikes.h) where the images are reconstructed so.
bool holds_back(const GradientImages& images, const ReconstructionSettings& settings);

struct Reconstruction {
    RgbImage image;      ///< radiance, very direct light included; empty when stopped
    double residual = 0; ///< relative residual of the normal equations (L2)
    int iterations = 0;  ///< inner solves, steps of weighted, or sweeps of uniform; 1 for L2, 0 for none
    double seconds = 0;  ///< wall time
    /// Of the light, without very direct light, what was held back and spread (recon/picture/spikes.h).
    double held_share = 0;
};

/// Reconstructs one image after the other, and keeps what the next can use: prepared transforms, memory, and where
/// its solvers stood. One call at a time.
class Reconstructor {
public:
    Reconstructor();
    ~Reconstructor();

    /// Does what the function below does, but if the last image was of this size, L1, mixed and weighted go on
    /// from where they last ended (a warm start), which is right if it had the same scene and view and a few
    /// samples less. Parts begin anew.
    Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                               const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

    /// The next image starts from nothing.
    void forget();

    /// The most memory that reconstruct() takes beside its images, on so many threads: for the picture, and for
    /// what its solver does not have already from images before.
    /// @param parts       GradientImages::parts
    /// @param is_limited  whether what bytes_to_limit() says (recon/picture/spikes.h) is asked for beside it
    std::uint64_t bytes_for(int width, int height, Norm norm, int threads = 1, int parts = 0,
                            bool is_limited = false) const;

private:
    struct Solvers;
    struct Limits;
    void finish(const GradientImages& images, const ReconstructionSettings& settings, const AlikePixels* alike,
                const Limits* limits, RgbImage& picture, const ParallelFor& parallel_for, const SolveWatch& watch);
    // `alike` is null above where nothing is smoothed or held back; below, where nothing is held back by guides.
    Reconstruction picture_of(const GradientImages& images, const ReconstructionSettings& settings,
                              const AlikePixels* alike, const ParallelFor& parallel_for, const SolveWatch& watch);
    int solve_weighted(const GradientImages& images, const PoissonProblem& problem, const AlikePixels* alike,
                       RgbImage& image, const ParallelFor& parallel_for, const SolveWatch& watch);
    RgbImage noise_of(const GradientImages& images, const ReconstructionSettings& settings, const Limits* limits,
                      const ParallelFor& parallel_for, const SolveWatch& watch);
    Reconstruction solve(const GradientImages& images, const ReconstructionSettings& settings,
                         const AlikePixels* alike, const ParallelFor& parallel_for, const SolveWatch& watch);

    std::unique_ptr<Solvers> solvers_; ///< for the size of the last image
};

/// The image whose gradients are (dx, dy) and whose values are the primal's, as nearly as the norm and alpha
/// allow (screened Poisson), plus very direct light. Without gradients, or with Norm::none, it is the primal
/// plus very direct light.
Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

} // namespace tessera
