#pragma once

#include "app/reference_image.h"
#include "app/scene_source.h"
#include "recon/reconstruct.h"
#include "render/method/settings.h"

#include <optional>

#include <glm/vec2.hpp>

namespace tessera {

/// The seeds of a reference are this and the next, unless others are asked for.
inline constexpr std::uint64_t first_reference_seed = 1001;

/// G-PR with large tiles, which few samples of a reference make up for.
RenderSettings reference_settings();

/// How a reference is made.
struct ReferenceRecipe {
    RenderSettings settings = reference_settings(); ///< of one half; the other has the next seed
    glm::ivec2 size{640, 360};
    int spp = 512;                                           ///< of both halves together; one more if it is odd
    ReconstructionSettings reconstruction{.norm = Norm::l2}; ///< linear, and so without bias
    double checkpoint_seconds = 60;                          ///< wall time between checkpoints
};

/// Renders a reference to `output`. While it does, OUTPUT.checkpoint is kept: whatever ends the program, the same
/// call goes on from there, and comes to the same bits as one that was never ended. Both halves grow together.
/// Empty: Ctrl-C ended it (see InterruptGuard), after a last checkpoint. Throws BadInput for a checkpoint of
/// another scene or other settings, std::runtime_error for one that cannot be read.
std::optional<ReferenceImage> render_reference(const std::filesystem::path& output, const SceneSource& source,
                                               const std::shared_ptr<const Scene>& scene,
                                               const ReferenceRecipe& recipe, ThreadPool& pool);

} // namespace tessera
