#include "render/load/numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tessera {

namespace {

constexpr std::string_view white_space = " \t\r\n";
constexpr std::string_view separators = " \t\r\n,";

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(white_space);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(white_space) - first + 1);
}

} // namespace

std::optional<double> parse_number(std::string_view text) {
    text = trim(text);
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || text.empty())
        return {};
    // Exporters write 1e-320 and smaller where they mean 0.
    if (error == std::errc::result_out_of_range && (text.find("e-") != text.npos || text.find("E-") != text.npos))
        return 0.0;
    if (error != std::errc() || !std::isfinite(value))
        return {};
    return value;
}

std::optional<std::vector<float>> parse_numbers(std::string_view text) {
    std::vector<float> numbers;
    while (true) {
        const std::size_t begin = text.find_first_not_of(separators);
        if (begin == std::string_view::npos)
            return numbers;
        text.remove_prefix(begin);
        const std::size_t length = std::min(text.find_first_of(separators), text.size());
        const auto number = parse_number(text.substr(0, length));
        if (!number || !std::isfinite(static_cast<float>(*number)))
            return {};
        numbers.push_back(static_cast<float>(*number));
        text.remove_prefix(length);
    }
}

} // namespace tessera
