#pragma once

#include "app/reconstruction_layers.h"

#include <filesystem>
#include <vector>

namespace tessera {

/// What `tessera reconstruct` is asked for.
struct ReconstructOptions {
    std::vector<std::filesystem::path> inputs; ///< as read_gradients takes them
    ReconstructionLayers layers{{Norm::weighted}};
    bool repair = false; ///< pixels that are not finite count as 0
    int threads = 0;     ///< 0: one a hardware thread
    std::filesystem::path output;
    std::filesystem::path stats; ///< empty: none
};

/// Returns an ExitCode. Throws BadInput or another std::exception before anything has been written.
int run_reconstruct(const ReconstructOptions& options);

} // namespace tessera
