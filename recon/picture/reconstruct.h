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

struct ReconstructionSettings {
    Norm norm = Norm::guided;
    float alpha = 0.2f;       ///< weight of the primal image against its gradients, > 0
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
    bool goes_on = false; ///< it was made with what was found about one before: anew it would differ by little
};

class PictureSolvers;

/// Reconstructs one image after the other, and keeps what the next can use: prepared transforms, memory, where its
/// solvers stood, and what was found about the picture. One call at a time.
class Reconstructor {
public:
    Reconstructor();
    ~Reconstructor();

    /// Does what the function below does, but goes on from the last image, if that was of this size (a warm
    /// start), which is right if it had the same scene and view and a few samples less. L1, mixed and weighted
    /// start from where they last ended. From the second image on, what was found about it beside its light is
    /// kept: which pixels look alike, and how far gradients, bright pixels and fine differences are to be trusted.
    /// With the same settings, images of less than a quarter more samples (GradientImages::brightest says how
    /// many) are made with that, in half of the time or less. Parts begin anew, and `oidn` keeps nothing.
    Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                               const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

    /// The next image starts from nothing.
    void forget();

    /// Whether what was found is kept, which takes memory from one image to the next.
    void set_keeps(bool keeps);

    /// The most memory that reconstruct() takes beside its images, on so many threads: for the picture, and for
    /// what its solver does not have already from images before.
    /// @param parts       GradientImages::parts
    /// @param is_limited  whether what bytes_to_limit() says (recon/picture/spikes.h) is asked for beside it
    std::uint64_t bytes_for(int width, int height, Norm norm, int threads = 1, int parts = 0,
                            bool is_limited = false) const;

    /// The memory that it takes beside these to keep what it finds.
    static std::uint64_t bytes_to_keep(int width, int height);

    /// The memory of what it has kept: the next image has it, or it goes before that is begun.
    std::uint64_t bytes_kept() const;

private:
    struct Fit;
    struct Task;
    Reconstruction picture_of(const Task& task);
    static void spread_held(const Task& task, RgbImage& image);
    RgbImage noise_of(const Task& task);
    RgbImage smooth(const Task& task, RgbImage& picture);
    void finish(const Task& task, RgbImage& picture);

    std::unique_ptr<PictureSolvers> solvers_; ///< for the size of the last image
    std::unique_ptr<Fit> fit_;                ///< of an image before; null: there is none
    bool keeps_ = true;
    bool has_variances_ = false; ///< the last image that was weighted
    bool has_solved_ = false;    ///< an image of the same scene and view
};

/// The image whose gradients are (dx, dy) and whose values are the primal's, as nearly as the norm and alpha
/// allow (screened Poisson), plus very direct light. Without gradients, or with Norm::none, it is the primal
/// plus very direct light.
Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

} // namespace tessera
