#pragma once

#include "app/scene_source.h"

#include <string>
#include <vector>

namespace tessera {

/// A scene of the suite.
struct StabilityScene {
    SceneSource source;
    int depth = 0;     ///< that it asks for
    std::string fails; ///< which method is known to fail there, and why; empty: the file does not say
};

/// Of each file the scene, or one for each value where it has <!-- vary: NAME = VALUE, VALUE, ... -->. What is
/// known to fail is in <!-- fails: ... -->. Throws BadInput that names a file that is not there or where a
/// variable has no values, and as open_scene does: all are loaded once.
std::vector<StabilityScene> stability_scenes(const std::vector<std::filesystem::path>& files, ThreadPool& pool);

/// The scenes that come with the program, in the order of their names: those of assets/stability of the folder at
/// hand, of the program's, or of one that either lies in. Throws BadInput where there are none.
std::vector<std::filesystem::path> built_in_stability_scenes();

} // namespace tessera
