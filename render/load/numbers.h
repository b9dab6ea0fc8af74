#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace tessera {

/// The whole text as a finite number, whatever the locale; spaces around it are allowed. Empty: it is none.
std::optional<double> parse_number(std::string_view text);

/// Numbers separated by commas or white space, each finite as a float. Empty: one of them is none.
std::optional<std::vector<float>> parse_numbers(std::string_view text);

} // namespace tessera
