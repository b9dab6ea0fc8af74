#pragma once

#include <filesystem>
#include <string>

namespace tessera {

struct CompareOptions {
    std::filesystem::path image;
    std::filesystem::path reference;
    std::filesystem::path reference2; ///< independent of the first; empty: there is none
    std::string layer;                ///< of `image`, such as "primal"; empty: its plain R, G, B
    bool json = false;
    int tile = 0; ///< edge of tiles whose grid is looked for in the error; 0: it is not
};

/// `tessera compare`: prints how far the image is from the reference, or from the mean of both. With two,
/// or one that `tessera reference` made and that has two halves, also the error that has no floor. Of other
/// references the plain R, G, B are taken, or `layer` where there are none. Returns the exit code: 0, or 2 with
/// one message on stderr for files that cannot be read or do not fit.
int run_compare(const CompareOptions& options);

} // namespace tessera
