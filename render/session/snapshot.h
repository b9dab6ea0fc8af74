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

/// What a pane shows: the state of a render after a whole number of passes. Immutable once published.
struct Snapshot {
    std::uint64_t generation = 0; ///< of the request that it answers
    int divisor = 1;              ///< of the size asked for; more than 1 in a preview (Previews)
    int spp = 0;                  ///< samples a pixel
    double seconds = 0;           ///< wall time spent on this pane's passes
    double cpu_seconds = 0;       ///< CPU time of all workers for these passes
    RenderSettings settings;
    std::weak_ptr<const Scene> scene; ///< gone once no other has a use for it: a picture keeps none alive
    Camera camera;
    std::shared_ptr<const LearnedReuse>
        learned; ///< of the newest pass: with the settings, its tiles (tile_grid.h)
    Counters counters;
    std::shared_ptr<const GradientImages> images;
    std::shared_ptr<const ReuseMaps> reuse; ///< null where pixels share nothing (path tracing)

    /// The newest pass that has been reconstructed, perhaps an older one than `images`; null at first.
    std::shared_ptr<const Reconstruction> reconstruction;
    ReconstructionSettings reconstructed_with; ///< what it was asked for with
    int reconstruction_spp = 0;                ///< the samples a pixel that it stands on
    double reconstruction_seconds = 0;         ///< the wall time spent on these samples

    bool coarse() const { return divisor > 1; }
};

} // namespace tessera
