#pragma once

#include "recon/parallel.h"
#include "render/io/text.h"
#include "render/load/scene_source.h"
#include "render/scene/scene.h"

#include <filesystem>
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

/// Reads a Mitsuba scene (0.6 or 3.x syntax) with the files that it includes. Paths are relative to the folder of
/// the file that they stand in; see FileSearch. Tells `progress`, if it is not null, how far it is. Throws
/// LoadError with file, line and column; std::runtime_error if the scene is given up on the way. A mesh whose file
/// is not there is left out, grey stands for such a texture, and a note says so that is an error; `strict`: that
/// throws, too.
LoadedScene load_mitsuba_xml(const std::filesystem::path& file, const SceneVariables& variables = {},
                             const ParallelFor& parallel_for = serial_for, LoadProgress* progress = nullptr,
                             bool strict = false);

/// Reads a scene in memory, which has no files beside it; `name` stands in messages.
LoadedScene parse_mitsuba_xml(std::string_view xml, const std::string& name, const SceneVariables& variables = {},
                              const ParallelFor& parallel_for = serial_for, LoadProgress* progress = nullptr);

} // namespace tessera
