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

// The first three functions report invalid samples (NaN, infinite), which a render leaves out. The others report
// results and costs of a render.

/// Returns the command that opens a sample of the render in the viewer: the options that determine its value and
/// are not defaults. Empty: the viewer does not support pictures of that size.
std::string inspect_command(const SceneSource& source, const Render& render, const InvalidSample& sample);

/// Prints to stderr the number of invalid samples, the first one, and how to open it; nothing if there are none.
void warn_of_invalid_samples(const SceneSource& source, const Render& render);

/// Returns an array of the first invalid samples: pixel, pass, seed and, if the viewer supports the size, the
/// command that opens it.
nlohmann::json invalid_samples_json(const SceneSource& source, const Render& render);

/// Prints to stderr which fraction of the radiance each reconstruction redistributed from fireflies; nothing if
/// none did.
void print_redistributed(const std::filesystem::path& output,
                         const std::vector<ReconstructionStats>& reconstructions);

/// Returns an array with the cost and the redistributed fraction of each reconstruction.
nlohmann::json reconstructions_json(const std::vector<ReconstructionStats>& reconstructions);

/// Returns the counts of rays, paths and shifts.
nlohmann::json counters_json(const Counters& counters);

/// Returns the contents of the --stats file: times in seconds, memory in bytes.
nlohmann::json stats_json(const nlohmann::json& settings, const OpenedScene& opened, const Render& render,
                          int threads, const std::vector<ReconstructionStats>& reconstructions, bool interrupted);

} // namespace tessera
