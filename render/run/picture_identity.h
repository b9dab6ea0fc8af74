#pragma once

#include "recon/picture/reconstruct.h"
#include "render/load/scene_source.h"
#include "render/run/thread_pool.h"
#include "render/scene/camera.h"
#include "render/settings/settings.h"

#include <memory>
#include <string>

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>

namespace tessera {

class Scene;

/// Returns everything that determines the picture, as JSON, for the headers of images and for statistics. Of the
/// reconstruction it contains alpha only.
nlohmann::json settings_json(const SceneSource& scene, RenderSettings settings, glm::ivec2 size, int spp,
                             const ReconstructionSettings& reconstruction);

/// Scene and view of a picture.
struct PictureSubject {
    SceneSource source;
    std::shared_ptr<const Scene> scene;
    Camera camera; ///< need not be the scene's own
};

/// Returns everything except the number of samples that determines a picture's bits, as JSON: version, size,
/// settings, camera, and checksums of the loaded scene. It does not depend on the location of files.
std::string picture_identity(const PictureSubject& subject, const RenderSettings& settings, glm::ivec2 size);

/// Describes how `theirs` differs from `mine`: "another scene", "another camera", "width 640, not 320"; empty:
/// they are equal.
std::string identity_difference(const std::string& theirs, const std::string& mine);

} // namespace tessera
