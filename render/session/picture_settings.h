#pragma once

#include "render/load/scene_source.h"
#include "render/method/settings.h"

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// Everything that decides the picture: goes into the header of every image and into the stats.
nlohmann::json settings_json(const SceneSource& scene, const RenderSettings& settings, glm::ivec2 size, int spp,
                             float alpha);

} // namespace tessera
