#pragma once

#include "app/scene_source.h"
#include "recon/reconstruct.h"
#include "render/session/render.h"

#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

struct ReconstructionStats {
    Norm norm;
    double seconds, cpu_seconds;
    int iterations;
    double residual;
};

/// Everything that decides the picture: goes into the header of every image and into the stats.
nlohmann::json settings_json(const SceneSource& scene, const RenderSettings& settings, glm::ivec2 size, int spp,
                             float alpha);

/// The contents of --stats: times in seconds, memory in bytes.
nlohmann::json stats_json(const nlohmann::json& settings, const OpenedScene& opened, const Render& render,
                          int threads, const std::vector<ReconstructionStats>& reconstructions, bool interrupted);

} // namespace tessera
