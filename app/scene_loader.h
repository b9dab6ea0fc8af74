#pragma once

#include "render/load/scene_source.h"
#include "ui/scene_load.h"

namespace tessera {

/// Makes the scene of `source`, with `threads` threads as in ThreadPool, whenever it is called: in the background,
/// the calling thread included, so that what draws comes first.
SceneLoader loader_of(const SceneSource& source, int threads);
/// With that loader.
SceneOrigin origin_of(const SceneSource& source, int threads);

} // namespace tessera
