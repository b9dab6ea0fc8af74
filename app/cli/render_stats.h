#pragma once

#include "app/cli/scene_source.h"
#include "app/cli/picture_layers.h"
#include "render/load/mitsuba_xml.h"
#include "render/run/picture_identity.h"
#include "render/run/render.h"

#include <string>
#include <vector>

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

/// An array of what each cost.
nlohmann::json reconstructions_json(const std::vector<ReconstructionStats>& reconstructions);

/// What was counted: rays, paths, shifts.
nlohmann::json counters_json(const Counters& counters);

/// The contents of --stats: times in seconds, memory in bytes.
nlohmann::json stats_json(const nlohmann::json& settings, const OpenedScene& opened, const Render& render,
                          int threads, const std::vector<ReconstructionStats>& reconstructions, bool interrupted);

} // namespace tessera
