#pragma once

#include "render/load/mitsuba_xml.h"

#include <filesystem>
#include <string>

namespace tessera {

/// Where a scene is from.
struct SceneSource {
    std::filesystem::path file;        ///< empty: the Cornell box inside the program
    SceneVariables variables;          ///< -D name=value
    std::filesystem::path camera = {}; ///< a file with the camera to take; empty: the scene's own
};

/// The name to show for it.
std::string to_string(const SceneSource& source);

/// A name for files that are made of it: the folder's for "kitchen/scene.xml" and "kitchen/scene_v3.xml", else the
/// file's; with the values of its variables, if it was given any: "glossy-0.01". All but letters, digits, "." and
/// "-" is "_" in these.
std::string scene_name(const SceneSource& source);

} // namespace tessera
