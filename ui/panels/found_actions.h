#pragma once

#include "ui/state/actions.h"

#include <string>
#include <vector>

namespace tessera {

/// The actions whose menu, name, help or key has all words of the text, in either case; those whose name begins
/// with the first word come first. All of them for an empty text.
std::vector<const Action*> actions_with(const std::string& text);

/// Whether something with these words is meant by a text, as above.
bool has_words(const std::string& something, const std::string& text);

} // namespace tessera
