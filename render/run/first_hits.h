#pragma once

#include "recon/image.h"
#include "render/scene/camera.h"

#include <stop_token>

#include <glm/vec2.hpp>

namespace tessera {

class Scene;

/// The first surface that the camera sees through the middle of each pixel; 0 where it sees nothing.
struct FirstHits {
    RgbImage albedo;    ///< directional albedo toward the camera
    RgbImage normal;    ///< shading normal, unit, world space
    Image<float> depth; ///< distance from the camera, scene units
    /// Square roots of the areas of footprints at x_1 and x_2 (Footprint), scene units: medians of five paths
    /// through each pixel; 0 where paths have no such vertex. Empty: not requested.
    Image<float> footprint_1, footprint_2;
};

/// Traces one ray per pixel, and five paths for footprints, in the calling thread. Returns empty images if it was
/// stopped.
FirstHits trace_first_hits(const Scene& scene, const Camera& camera, glm::ivec2 size, bool with_footprints = false,
                           std::stop_token stop = {});

/// Returns the distance to the first surface, in scene units; 0: the camera sees nothing.
/// @param place  point of a picture of that size, in pixels from its top left corner
float first_hit_distance(const Scene& scene, const Camera& camera, glm::vec2 place, glm::ivec2 size);

} // namespace tessera
