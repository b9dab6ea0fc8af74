#pragma once

#include "recon/image.h"
#include "render/scene/camera.h"

#include <stop_token>

#include <glm/vec2.hpp>

namespace tessera {

class Scene;

/// What the camera sees first through the middle of each pixel; 0 where it sees nothing.
struct FirstHits {
    RgbImage albedo;    ///< share of light that would be scattered to the camera if it came from everywhere
    RgbImage normal;    ///< of shading, unit, in the world
    Image<float> depth; ///< distance from the camera, in units of the scene
    /// How wide the footprint of a path is at x_1 and x_2 (PathDifferentials): the root of its area, in units of
    /// the scene, the median of five paths through each pixel; 0 where they do not come that far. Empty: not asked
    /// for.
    Image<float> footprint_1, footprint_2;
};

/// Traces one ray a pixel, or five paths where footprints are asked for, in the calling thread. Empty
/// images: stopped on the way.
FirstHits trace_first_hits(const Scene& scene, const Camera& camera, glm::ivec2 size, bool with_footprints = false,
                           std::stop_token stop = {});

/// How far away is what the camera sees at a place of a picture of that size, pixels from its top left; 0:
/// nothing.
float first_hit_distance(const Scene& scene, const Camera& camera, glm::vec2 place, glm::ivec2 size);

} // namespace tessera
