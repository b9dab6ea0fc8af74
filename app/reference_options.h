#pragma once

#include "app/reference.h"

#include <string>
#include <vector>

#include <CLI/App.hpp>

namespace tessera {

/// The words of `tessera reference`, before they are given a meaning.
struct ReferenceWords {
    std::string scene, camera, size, method = "gpr", norms;
    std::vector<std::string> definitions;
    ReferenceOptions options; ///< all that is not above
};

/// Adds the command; `words` take what is given to it, and must live as long as `app`.
void add_reference(CLI::App& app, ReferenceWords& words);

/// What the words mean. Throws BadInput that names the option.
ReferenceOptions parse_reference(const CLI::App& command, const ReferenceWords& words);

} // namespace tessera
