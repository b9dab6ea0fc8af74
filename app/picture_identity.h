#pragma once

#include "app/scene_source.h"
#include "render/method/settings.h"

#include <string>

#include <glm/vec2.hpp>

namespace tessera {

/// Of the scene's file, and of a few samples of a small picture with these settings: so it knows meshes, textures,
/// camera and the program itself by what they do, wherever the files lie.
std::uint32_t scene_checksum(const SceneSource& source, const std::shared_ptr<const Scene>& scene,
                             const RenderSettings& settings, ThreadPool& pool);

/// What decides a picture's bits, but for the number of samples, as JSON: version, size, settings, and the
/// scene's checksum.
std::string picture_identity(const SceneSource& source, const std::shared_ptr<const Scene>& scene,
                             const RenderSettings& settings, glm::ivec2 size, ThreadPool& pool);

/// How `theirs` differs from `mine`: "another scene", "width 640, not 320"; empty: it does not.
std::string identity_difference(const std::string& theirs, const std::string& mine);

} // namespace tessera
