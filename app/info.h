#pragma once

#include "app/scene_source.h"

namespace tessera {

/// `tessera info`: prints what was loaded, what it takes in time and memory, what the renderer must reckon with,
/// and what was ignored or replaced, with its place in the file. Returns an ExitCode.
int run_info(const SceneSource& source);

} // namespace tessera
