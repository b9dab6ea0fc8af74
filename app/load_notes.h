#pragma once

#include "render/load/messages.h"

#include <string>
#include <vector>

namespace tessera {

/// A line for each text: "file:line:column: text", with the places of further notes of the same text behind it, of
/// which some are named and the others counted. In order of the first places.
std::vector<std::string> group_notes(const std::vector<LoadNote>& notes);

} // namespace tessera
