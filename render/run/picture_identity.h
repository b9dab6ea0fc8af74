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

/// Everything that decides the picture, as JSON: it goes into the header of every image and into the stats.
/// Of the reconstruction it has what all norms have in common.
nlohmann::json settings_json(const SceneSource& scene, RenderSettings settings, glm::ivec2 size, int spp,
                             const ReconstructionSettings& reconstruction);

/// What a picture shows.
struct PictureSubject {
    SceneSource source;
    std::shared_ptr<const Scene> scene;
    Camera camera; ///< the scene's, or another
};

/// What decides a picture's bits, but for the number of samples, as JSON: version, size, settings, camera, and the
/// checksums of all that was loaded of the scene, wherever its files lie.
std::string picture_identity(const PictureSubject& subject, const RenderSettings& settings, glm::ivec2 size);

/// How `theirs` differs from `mine`: "another scene", "another camera", "width 640, not 320"; empty: it does not.
std::string identity_difference(const std::string& theirs, const std::string& mine);

} // namespace tessera
