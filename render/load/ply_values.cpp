#include "render/load/ply_values.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace tessera {

namespace {

constexpr std::string_view white_space = " \t\r\n";
constexpr std::size_t longest_word = 4096; // bytes; a longer one is no number

} // namespace

template <class T>
T PlyValues::next_binary() {
    if (!bytes_.fill(sizeof(T)))
        throw std::runtime_error("the file ends too early");
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.bytes().data(), sizeof(T));
    bytes_.take(sizeof(T));
    const bool is_native = (format_ == PlyFormat::little_endian) == (std::endian::native == std::endian::little);
    if (!is_native)
        for (std::size_t i = 0; i < sizeof(T) / 2; ++i)
            std::swap(raw[i], raw[sizeof(T) - 1 - i]);
    return std::bit_cast<T>(raw);
}

void PlyValues::skip_white_space() {
    while (bytes_.fill(1)) {
        const std::size_t begin = bytes_.bytes().find_first_not_of(white_space);
        if (begin != std::string_view::npos)
            return bytes_.take(begin);
        bytes_.take(bytes_.bytes().size());
    }
    throw std::runtime_error("the file ends too early");
}

double PlyValues::next_word() {
    skip_white_space();
    bytes_.fill(longest_word);
    const std::string_view word = bytes_.bytes().substr(0, bytes_.bytes().find_first_of(white_space));
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto [read, error] = std::from_chars(word.data() + (word.front() == '+' ? 1 : 0), end, value);
    if (read != end || error == std::errc::invalid_argument)
        throw std::runtime_error("'" + std::string(word.substr(0, 40)) + "' is not a number");
    bytes_.take(word.size());
    return value;
}

double PlyValues::next(PlyType type) {
    if (is_text())
        return next_word();
    switch (type) {
    case PlyType::int8:
        return next_binary<std::int8_t>();
    case PlyType::uint8:
        return next_binary<std::uint8_t>();
    case PlyType::int16:
        return next_binary<std::int16_t>();
    case PlyType::uint16:
        return next_binary<std::uint16_t>();
    case PlyType::int32:
        return next_binary<std::int32_t>();
    case PlyType::uint32:
        return next_binary<std::uint32_t>();
    case PlyType::float32:
        return static_cast<double>(next_binary<float>());
    case PlyType::float64:
        break;
    }
    return next_binary<double>();
}

} // namespace tessera
