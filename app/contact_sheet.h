#pragma once

#include "app/scene_source.h"

#include <filesystem>

namespace tessera {

struct ContactSheetOptions {
    SceneSource scene;
    std::filesystem::path output = "contact-sheet.png";
    glm::ivec2 size{0}; ///< of each picture; 0: the scene's own, at most about 640x360 pixels in all
    double seconds = 5; ///< wall seconds of rendering for each method
    int threads = 0;
};

/// The viewer's comparison for machines without a display: path tracing and gradient-domain path reusing side by
/// side, with the latter's primal and gradients, labelled, as one PNG. Returns an ExitCode.
int run_contact_sheet(const ContactSheetOptions& options);

} // namespace tessera
