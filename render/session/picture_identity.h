#pragma once

#include "render/load/scene_source.h"
#include "render/method/settings.h"
#include "render/scene/scene.h"
#include "render/session/thread_pool.h"

#include <memory>
#include <string>

#include <glm/vec2.hpp>

namespace tessera {

/// What a picture shows.
struct PictureSubject {
    SceneSource source;
    std::shared_ptr<const Scene> scene;
    Camera camera; ///< the scene's, or another
};

/// Of the scene's file, and of a few samples of a small picture with these settings: so it knows meshes, textures,
/// camera and the program itself by what they do, wherever the files lie.
std::uint32_t scene_checksum(const PictureSubject& subject, const RenderSettings& settings, ThreadPool& pool);

/// What decides a picture's bits, but for the number of samples, as JSON: version, size, settings, camera, and the
/// scene's checksum.
std::string picture_identity(const PictureSubject& subject, const RenderSettings& settings, glm::ivec2 size,
                             ThreadPool& pool);

/// How `theirs` differs from `mine`: "another scene", "another camera", "width 640, not 320"; empty: it does not.
std::string identity_difference(const std::string& theirs, const std::string& mine);

} // namespace tessera
