#pragma once

#include "app/reference_run.h"

namespace tessera {

/// What `tessera reference` is asked for.
struct ReferenceOptions {
    SceneSource scene;
    ReferenceRecipe recipe;
    std::optional<int> max_depth;   ///< empty: the scene's own
    std::optional<glm::ivec2> size; ///< empty: the scene's own
    int threads = 0;                ///< 0: one a hardware thread
    std::filesystem::path output;
};

/// Renders a reference, from a checkpoint if there is one, and prints its error. Returns an ExitCode: failure if
/// Ctrl-C came before it was complete. Throws BadInput, LoadError or another std::exception.
int run_reference(const ReferenceOptions& options);

} // namespace tessera
