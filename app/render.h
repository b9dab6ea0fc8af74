#pragma once

#include "app/scene_source.h"
#include "recon/reconstruct.h"
#include "render/method/settings.h"

#include <filesystem>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

enum class Clock { wall, cpu };

/// What `tessera render` is asked for.
struct RenderOptions {
    SceneSource scene;
    RenderSettings settings;
    std::optional<int> max_depth; ///< empty: the scene's own
    std::optional<int> spp;       ///< passes; empty: by time, or 16
    std::optional<double> time;   ///< seconds of rendering, without loading
    Clock clock = Clock::wall;
    std::optional<glm::ivec2> size; ///< empty: the scene's own
    std::vector<Norm> norms; ///< empty: weighted where there are gradients; the first is the file's plain RGB
    float alpha = 0.2f;
    bool per_channel = false; ///< l1 and mixed: each channel is on its own
    int threads = 0;          ///< 0: one a hardware thread
    std::filesystem::path output;
    std::filesystem::path stats; ///< empty: none
    bool buffers = false;        ///< primal, dx, dy, direct and the variances as layers, too
};

/// Returns an ExitCode. Throws BadInput, LoadError or another std::exception before anything has been written.
int run_render(const RenderOptions& options);

} // namespace tessera
