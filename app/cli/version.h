#pragma once

#include <string>

namespace tessera {

/// Returns the version and the commit of the source, such as "0.2.0 (commit 1a2b3c4)". The commit ends with
/// "-dirty" if the source had changes when the build was configured. It is left out if the source is not a git
/// checkout.
std::string version_text();

} // namespace tessera
