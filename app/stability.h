#pragma once

#include "app/experiment.h"

#include <filesystem>

namespace tessera {

/// `tessera stability`: renders small scenes, each made so that some method is known to fail, with all methods and
/// reconstructions, and judges them by path tracing (app/verdict.h). Writes stability.md, stability.csv and a
/// sheet of pictures a scene, anew after each round; each scene's journal and pictures are in a folder of its own,
/// OUTPUT/scenes/SCENE. No `options.scenes`: those that come with the program. Depths are the scenes' own. Returns
/// an ExitCode. Throws BadInput or another std::exception before anything was rendered.
int run_stability(ExperimentOptions options);

} // namespace tessera
