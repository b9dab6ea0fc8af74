#pragma once

#include "app/effort.h"
#include "app/measurement.h"
#include "recon/reconstruct.h"
#include "render/session/reference_image.h"
#include "render/session/render.h"

#include <memory>
#include <vector>

namespace tessera {

/// A render that is measured on its way, with one or several reconstructions: measuring costs it no time.
class MeasuredRun {
public:
    /// Is measured after effort / 2^halvings, ..., effort / 2, effort: at the first pass that is not before. Where
    /// one pass is past several of these, only the last counts. Artefacts are looked for on demand. Keeps
    /// references to the reference and the pool.
    MeasuredRun(Render render, const Effort& effort, int halvings,
                std::vector<ReconstructionSettings> reconstructions, bool looks_for_artefacts,
                const ReferenceImage& reference, ThreadPool& pool);

    double done() const; ///< share of the effort; 1 and more: it is at its end
    bool is_done() const { return done() >= 1; }
    /// One more pass, and measures when it is time to.
    void pass();

    /// Of each reconstruction, in the order of time.
    const std::vector<std::vector<Measurement>>& measurements() const { return measurements_; }
    /// The last picture measured, of each reconstruction.
    const std::vector<RgbImage>& images() const { return images_; }
    const Render& render() const { return render_; }

private:
    void measure(int halvings);

    Render render_;
    Effort effort_;
    int next_halvings_; ///< of the measurement to come
    std::vector<ReconstructionSettings> reconstructions_;
    bool looks_for_artefacts_;
    const ReferenceImage& reference_;
    ThreadPool& pool_;
    std::vector<std::vector<Measurement>> measurements_;
    std::vector<RgbImage> images_;
};

} // namespace tessera
