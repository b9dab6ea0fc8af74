#pragma once

#include "recon/image.h"
#include "recon/picture/reconstruct.h"
#include "render/film/counters.h"
#include "render/film/film.h"
#include "render/scene/camera.h"
#include "render/settings/settings.h"

#include <cstdint>
#include <memory>

namespace tessera {

class LearnedReuse;
class Scene;

/// State of a render after a whole number of passes, which a pane shows. Immutable once published.
struct Snapshot {
    std::uint64_t generation = 0; ///< of its request
    int divisor = 1;              ///< of the requested size; more than 1 for a preview (Previews)
    int spp = 0;                  ///< samples per pixel
    double seconds = 0;           ///< wall time of the passes
    double cpu_seconds = 0;       ///< CPU time of all workers for the passes
    RenderSettings settings;
    std::weak_ptr<const Scene> scene; ///< weak, so that a picture keeps no replaced scene in memory
    Camera camera;
    std::shared_ptr<const LearnedReuse> learned; ///< used by the newest pass; with the settings it gives the tiles
    Counters counters;
    std::shared_ptr<const GradientImages> images;
    std::shared_ptr<const ReuseMaps> reuse; ///< null with PT

    /// The newest reconstruction, perhaps of an earlier pass than `images`; null before the first.
    std::shared_ptr<const Reconstruction> reconstruction;
    ReconstructionSettings reconstructed_with; ///< its settings
    int reconstruction_spp = 0;                ///< its samples per pixel
    double reconstruction_seconds = 0;         ///< wall time of these samples

    bool coarse() const { return divisor > 1; }
};

} // namespace tessera
