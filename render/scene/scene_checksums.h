#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tessera {

struct Camera;
struct SceneDescription;

/// Checksums of all that a picture shows, part by part: two scenes that are alike have the same ones, whatever
/// their files and ids are called and wherever they lie. They are taken of what was loaded, bit by bit, and know
/// nothing of how it is rendered, nor of the size of the film.
struct SceneChecksums {
    std::uint32_t geometry = 0;
    std::uint32_t materials = 0; ///< shape by shape, textures and all
    std::uint32_t lights = 0;    ///< emission of shapes, lights without shape, environment
    std::uint32_t camera = 0;

    bool operator==(const SceneChecksums&) const = default;
};

SceneChecksums checksums_of(const SceneDescription& scene, const Camera& camera);

/// A text for headers and keys: "geometry 8c1f00d2 materials 00000000 lights 00000000 camera 00000000".
std::string to_string(const SceneChecksums& sums);
/// What such a text says; empty: it is none.
std::optional<SceneChecksums> scene_checksums_from(const std::string& text);

/// The parts in which the two differ: "geometry", "materials and camera"; empty: they do not.
std::string difference(const SceneChecksums& a, const SceneChecksums& b);

} // namespace tessera
