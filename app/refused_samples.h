#pragma once

#include "render/load/scene_source.h"
#include "render/session/render.h"

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

// What is told of samples that were not finite and were left out of a render.

/// The command that opens a sample of such a render in the viewer: what decides its bits and is not so by itself.
/// Empty: the viewer has no pictures of that size.
std::string inspect_command(const SceneSource& source, const Render& render, const RefusedSample& sample);

/// Says on stderr how many there were, which was the first, and how to look at it. Nothing, if there were none.
void warn_of_refused(const SceneSource& source, const Render& render);

/// The first of them: pixel, pass and seed, and the command that opens them, if one does. Empty: there
/// were none.
nlohmann::json refused_json(const SceneSource& source, const Render& render);

} // namespace tessera
