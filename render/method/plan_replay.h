#pragma once

#include "render/method/reuse_plan.h"
#include "render/scene/scene.h"

#include <stop_token>

#include <glm/vec2.hpp>

namespace tessera {

/// The plan that a pass of a render had, as far as the tile of one pixel goes: bit for bit, and good for no other
/// tile. It is learnt again from the base paths of the passes before, of the few pixels that decide on that tile;
/// this costs as much as path tracing some 16 x 16 pixels as often.
/// @param pass  counts from 0
/// @param stop  ends it early: it has then learnt less, and is good for nothing
ReusePlan replay_plan(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
                      int pass, glm::ivec2 pixel, std::stop_token stop = {});

} // namespace tessera
