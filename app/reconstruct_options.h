#pragma once

#include "app/reconstruct.h"

#include <string>
#include <vector>

#include <CLI/App.hpp>

namespace tessera {

/// The words of `tessera reconstruct`, before they are given a meaning.
struct ReconstructWords {
    std::vector<std::string> inputs;
    std::string primal, dx, dy, direct; ///< the inputs by their names instead
    std::string norms = "weighted";
    ReconstructOptions options; ///< all that is not above
};

/// Adds the command; `words` take what is given to it, and must live as long as `app`.
void add_reconstruct(CLI::App& app, ReconstructWords& words);

/// What the words mean. Throws BadInput that names the option.
ReconstructOptions parse_reconstruct(const ReconstructWords& words);

} // namespace tessera
