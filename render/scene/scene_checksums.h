#pragma once

#include "render/scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>

namespace tessera {

/// Of all that a picture shows, part by part: two scenes that are alike have the same ones, whatever their files
/// and ids are called and wherever they lie. Of what was loaded, bit by bit: they know nothing of how it is
/// rendered, nor of the size of the film.
struct SceneChecksums {
    std::uint32_t geometry = 0;
    std::uint32_t materials = 0; ///< shape by shape, textures and all
    std::uint32_t lights = 0;    ///< emission of shapes, lights without shape, environment
    std::uint32_t camera = 0;

    bool operator==(const SceneChecksums&) const = default;
};

SceneChecksums checksums_of(const SceneDescription& scene, const Camera& camera);

/// "geometry 8c1f00d2 materials ...", for headers and keys; and back. Empty: it is no such text.
std::string to_string(const SceneChecksums& sums);
std::optional<SceneChecksums> scene_checksums_from(const std::string& text);

/// What is another in one than in the other: "geometry", "materials and camera"; empty: nothing.
std::string difference(const SceneChecksums& a, const SceneChecksums& b);

} // namespace tessera
