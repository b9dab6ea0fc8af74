#pragma once

#include <string>
#include <string_view>

namespace tessera {

/// Text as HTML and XML have it: <, >, & and quotes by their names, control characters as spaces.
std::string escaped(std::string_view text);

} // namespace tessera
