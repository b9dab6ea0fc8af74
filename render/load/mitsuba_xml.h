#pragma once

#include "recon/parallel.h"
#include "render/io/text.h"
#include "render/load/load_progress.h"
#include "render/scene/scene.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

struct LoadedScene {
    SceneDescription description;
    std::vector<LoadNote> notes; ///< in order of the file; nothing is ignored or replaced without one
    double parse_seconds = 0;    ///< wall time for the XML
    double file_seconds = 0;     ///< wall time for meshes and textures
};

/// `-D name=value` of the command line: replaces the <default> of that name.
using SceneVariables = std::map<std::string, std::string>;

/// Reads a Mitsuba scene (0.6 or 3.x syntax) with the files that it includes. Paths are relative to the folder of
/// the file that they stand in; see FileSearch. Tells `progress`, if it is not null, how far it is. Throws
/// LoadError with file, line and column; std::runtime_error if the scene is given up on the way.
LoadedScene load_mitsuba_xml(const std::filesystem::path& file, const SceneVariables& variables = {},
                             const ParallelFor& parallel_for = serial_for, LoadProgress* progress = nullptr);

/// Reads a scene in memory, which has no files beside it; `name` stands in messages.
LoadedScene parse_mitsuba_xml(std::string_view xml, const std::string& name, const SceneVariables& variables = {},
                              const ParallelFor& parallel_for = serial_for, LoadProgress* progress = nullptr);

/// Where a scene is from.
struct SceneSource {
    std::filesystem::path file;        ///< empty: the Cornell box inside the program
    SceneVariables variables;          ///< -D name=value
    std::filesystem::path camera = {}; ///< a file with the camera to take; empty: the scene's own
};

/// The name to show for a scene: the path of its file, or that it is the built-in one.
std::string to_string(const SceneSource& source);

/// A name for files that are made of it: the folder's for "kitchen/scene.xml" and "kitchen/scene_v3.xml", else the
/// file's; with the values of its variables, if it was given any: "glossy-0.01". All but letters, digits, "." and
/// "-" is "_" in these.
std::string scene_name(const SceneSource& source);

} // namespace tessera
