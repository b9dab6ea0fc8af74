#pragma once

#include "app/cli/opened_scene.h"
#include "app/cli/picture_layers.h"
#include "render/load/scene_source.h"
#include "render/run/picture_identity.h"
#include "render/run/render.h"

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

// The first three functions report invalid samples (NaN, infinite), which a render leaves out; the others report
// what a render did and cost.

/// The command that opens a sample of such a render in the viewer: what decides its bits and is not so by itself.
/// Empty: the viewer has no pictures of that size.
std::string inspect_command(const SceneSource& source, const Render& render, const RefusedSample& sample);

/// Says on stderr how many there were, which was the first, and how to look at it. Nothing, if there were none.
void warn_of_refused(const SceneSource& source, const Render& render);

/// The first refused sample: pixel, pass and seed, and the command that opens it and the others, if one does.
/// Empty: there was none.
nlohmann::json refused_json(const SceneSource& source, const Render& render);

/// Prints to stderr which fraction of the radiance each reconstruction redistributed from fireflies; nothing if
/// none did.
void print_redistributed(const std::filesystem::path& output,
                         const std::vector<ReconstructionStats>& reconstructions);

/// Returns an array with the cost and the redistributed fraction of each reconstruction.
nlohmann::json reconstructions_json(const std::vector<ReconstructionStats>& reconstructions);

/// What was counted: rays, paths, shifts.
nlohmann::json counters_json(const Counters& counters);

/// The contents of --stats: times in seconds, memory in bytes.
nlohmann::json stats_json(const nlohmann::json& settings, const OpenedScene& opened, const Render& render,
                          int threads, const std::vector<ReconstructionStats>& reconstructions, bool interrupted);

} // namespace tessera
