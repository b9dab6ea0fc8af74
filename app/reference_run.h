#pragma once

#include "render/session/reference_render.h"

#include <optional>

namespace tessera {

/// Renders a reference to `output` (see ReferenceRender), telling on the terminal how far it is. Empty: Ctrl-C
/// ended it (see InterruptGuard), after a last checkpoint. Throws as ReferenceRender does.
std::optional<ReferenceImage> render_reference(const std::filesystem::path& output, const SceneSource& source,
                                               const std::shared_ptr<const Scene>& scene,
                                               const ReferenceRecipe& recipe, ThreadPool& pool);

} // namespace tessera
