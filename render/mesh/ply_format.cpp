#include "render/mesh/ply_format.h"

#include "render/io/text.h"
#include "render/mesh/mesh_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace tessera {

namespace {

constexpr std::string_view white_space = " \t\r\n";

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
        line.remove_prefix(std::min(line.find_first_not_of(white_space), line.size()));
        if (line.empty())
            return words;
        const std::size_t length = std::min(line.find_first_of(white_space), line.size());
        words.push_back(line.substr(0, length));
        line.remove_prefix(length);
    }
}

struct TypeName {
    std::string_view name;
    PlyType type;
};
constexpr TypeName type_names[] = {
    {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64},
};

class HeaderParser {
public:
    explicit HeaderParser(std::string_view bytes) : bytes_(bytes) {}

    PlyHeader parse() {
        if (words_of(next_line()) != std::vector<std::string_view>{"ply"})
            fail("the file does not begin with 'ply'");
        while (true) {
            const std::vector<std::string_view> words = words_of(next_line());
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info")
                continue;
            if (words[0] == "end_header")
                break;
            if (words[0] == "format")
                parse_format(words);
            else if (words[0] == "element")
                parse_element(words);
            else if (words[0] == "property")
                parse_property(words);
            else
                fail("'" + std::string(words[0]) + "' is not a header keyword");
        }
        if (!has_format_)
            fail("the header names no format");
        header_.size = at_;
        return header_;
    }

private:
    [[noreturn]] void fail(const std::string& text) const {
        throw std::runtime_error("line " + std::to_string(line_) + ": " + text);
    }

    std::string_view next_line() {
        ++line_;
        const std::size_t end = bytes_.find('\n', at_);
        if (end == std::string_view::npos)
            fail("the header has no end");
        const std::string_view line = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        return line;
    }

    void parse_format(const std::vector<std::string_view>& words) {
        if (words.size() != 3 || words[2] != "1.0")
            fail("the format must be 'ascii', 'binary_little_endian' or 'binary_big_endian', version 1.0");
        if (words[1] == "ascii")
            header_.format = PlyFormat::ascii;
        else if (words[1] == "binary_little_endian")
            header_.format = PlyFormat::little_endian;
        else if (words[1] == "binary_big_endian")
            header_.format = PlyFormat::big_endian;
        else
            fail("the format '" + std::string(words[1]) + "' is not known");
        has_format_ = true;
    }

    void parse_element(const std::vector<std::string_view>& words) {
        PlyElement element;
        if (words.size() != 3)
            fail("an element needs a name and a count");
        const char* const end = words[2].data() + words[2].size();
        const auto [read, error] = std::from_chars(words[2].data(), end, element.count);
        if (read != end || error != std::errc())
            fail("'" + std::string(words[2]) + "' is not a count");
        element.name = words[1];
        header_.elements.push_back(element);
    }

    void parse_property(const std::vector<std::string_view>& words) {
        if (header_.elements.empty())
            fail("a property precedes the first element");
        PlyProperty property;
        property.is_list = words.size() == 5 && words[1] == "list";
        if (words.size() != 3 && !property.is_list)
            fail("a property needs a type and a name, or 'list', two types and a name");
        if (property.is_list)
            property.count_type = parse_type(words[2]);
        property.type = parse_type(words[words.size() - 2]);
        property.name = words.back();
        if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64)
            fail("the length of a list must be an integer");
        header_.elements.back().properties.push_back(property);
    }

    PlyType parse_type(std::string_view name) const {
        for (const TypeName& known : type_names)
            if (known.name == name)
                return known.type;
        fail("the type '" + std::string(name) + "' is not known");
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
    int line_ = 0;
    bool has_format_ = false;
    PlyHeader header_;
};

constexpr std::size_t max_word_length = 4096; // bytes; a longer one is no number

} // namespace

std::size_t size_of(PlyType type) {
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
        return 4;
    case PlyType::float64:
        break;
    }
    return 8;
}

PlyHeader parse_ply_header(std::string_view bytes) {
    return HeaderParser(bytes).parse();
}

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
    bytes_.fill(max_word_length);
    const std::string_view word = bytes_.bytes().substr(0, bytes_.bytes().find_first_of(white_space));
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto [read, error] = std::from_chars(word.data() + (word.front() == '+' ? 1 : 0), end, value);
    if (is_non_finite_word(word))
        value = std::numeric_limits<double>::quiet_NaN();
    else if (read != end || error == std::errc::invalid_argument)
        throw std::runtime_error("'" + std::string(word.substr(0, 40)) + "' is not a number");
    else if (error == std::errc::result_out_of_range) // underflow or overflow
        value = parse_number(word).value_or(std::numeric_limits<double>::infinity());
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
