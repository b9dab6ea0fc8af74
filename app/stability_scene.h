#pragma once

#include "app/scene_source.h"

#include <optional>
#include <string>
#include <vector>

#include <glm/ext/vector_int2.hpp>

namespace tessera {

/// What a scene needs to fail, if not what the suite gives to all.
struct StabilityNeeds {
    std::optional<int> spp;
    std::optional<int> seeds;
    std::optional<glm::ivec2> size; ///< pixels
};

/// A scene of the suite.
struct StabilityScene {
    SceneSource source;
    int depth = 0;     ///< that it asks for
    std::string fails; ///< which method is known to fail there, and why; empty: the file does not say
    StabilityNeeds needs;
};

/// Of each file the scene, or one for each value where it has <!-- vary: NAME = VALUE, VALUE, ... -->. What is
/// known to fail is in <!-- fails: ... -->, what it needs for that in <!-- needs: ... -->: "100000 spp, 3 seeds,
/// 16x16 pixels", any of these. Throws BadInput that names a file that is not there, where a variable has no
/// values, or where a need is none of these; and as load_mitsuba_xml does: all are read once.
std::vector<StabilityScene> stability_scenes(const std::vector<std::filesystem::path>& files);

/// The scenes that come with the program, in the order of their names: those of assets/stability of the folder at
/// hand, of the program's, or of one that either lies in. Throws BadInput where there are none.
std::vector<std::filesystem::path> built_in_stability_scenes();

} // namespace tessera
