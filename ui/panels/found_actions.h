#pragma once

#include "ui/state/actions.h"

#include <string>
#include <vector>

namespace tessera {

/// Returns the actions whose menu, name, help or keys contain all words of the text, ignoring case; first those
/// whose name starts with the first word. An empty text returns all actions.
std::vector<const Action*> actions_with(const std::string& text);

/// Whether `entry` contains all words of the text, ignoring case.
bool has_words(const std::string& entry, const std::string& text);

} // namespace tessera
