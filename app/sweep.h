#pragma once

#include "app/sweep_points.h"
#include "recon/reconstruct.h"

#include <filesystem>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// What `tessera sweep` is asked for.
struct SweepOptions {
    std::vector<std::filesystem::path> scenes;
    std::vector<Method> methods = {Method::gpr};
    std::vector<Variation> variations; ///< at most two
    RenderSettings settings;           ///< of all points, but for what is varied
    int spp = 64;
    std::optional<double> time; ///< CPU seconds of rendering; replaces spp
    int seeds = 1;              ///< renders of each point, with the seeds settings.seed, settings.seed + 1, ...
    glm::ivec2 size{640, 360};
    ReconstructionSettings reconstruction; ///< of methods with gradients
    std::filesystem::path references;      ///< folder of the references; what is missing there is made
    int reference_spp = 256;
    std::filesystem::path output; ///< folder, made where there is none
    int threads = 0;              ///< 0: one a hardware thread
};

/// Renders every scene with every point of the sweep, compares with two independent references, and writes
/// sweep.csv, .json, .md and a chart a scene: anew after each render, so that whatever ends it loses no more than
/// that one. Returns an ExitCode. Throws BadInput or another std::exception before anything was rendered, but for
/// scene files that cannot be loaded: these are met in turn.
int run_sweep(const SweepOptions& options);

} // namespace tessera
