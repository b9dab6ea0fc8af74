#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tessera {

struct Camera;
struct SceneDescription;

/// Checksums of everything in a scene that affects its picture. They cover the loaded data bit by bit, but no
/// names or paths of files, no ids, no render settings, and not the film size.
struct SceneChecksums {
    std::uint32_t geometry = 0;
    std::uint32_t materials = 0; ///< of each shape, with textures
    std::uint32_t lights = 0;    ///< emission of shapes, other lights, environment
    std::uint32_t camera = 0;

    bool operator==(const SceneChecksums&) const = default;
};

/// Computes the checksums of a scene seen by `camera` instead of its own camera.
SceneChecksums checksums_of(const SceneDescription& scene, const Camera& camera);

/// Returns a text for headers and keys: "geometry 8c1f00d2 materials 00000000 lights 00000000 camera 00000000".
std::string to_string(const SceneChecksums& sums);
/// Parses such a text; empty if it is malformed.
std::optional<SceneChecksums> scene_checksums_from(const std::string& text);

/// Names the differing checksums, such as "geometry" or "materials and camera"; empty if all are equal.
std::string difference(const SceneChecksums& a, const SceneChecksums& b);

} // namespace tessera
