#pragma once

#include "render/estimator/base_block.h"
#include "render/estimator/path_reuse.h"
#include "render/estimator/sampling_set.h"
#include "render/film/counters.h"
#include "render/paths/tracer.h"
#include "render/settings/settings.h"

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// Memory and counters of one thread, reused from block to block.
struct Worker {
    /// Keeps references to all arguments except the camera.
    /// @param guiding  of this pass; null: none
    Worker(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
           const PathGuiding* guiding)
        : tracer{scene,
                 counters,
                 settings,
                 {settings.filter_textures, is_demodulated(settings), camera, size},
                 guiding && guiding->draws() ? guiding : nullptr},
          reuse(tracer, settings) {}
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Returns an estimate of a worker's memory. Base paths take most of it, and their lengths vary.
    static std::uint64_t bytes(const RenderSettings& settings);

    Counters counters;
    std::vector<FoundLight> found; ///< by the guiding paths of the block
    double cpu_seconds = 0;
    Tracer tracer;
    PathReuse reuse;
    BaseBlock base;
    BasePath path;
    SamplingSet set;
    SetMeans set_means;              ///< of the block
    ArrivingLight own;               ///< of one base path
    std::vector<Rgb> own_components; ///< its basis components
};

} // namespace tessera
