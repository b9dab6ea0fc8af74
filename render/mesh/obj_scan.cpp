#include "render/mesh/obj_scan.h"

#include "render/mesh/mesh_file.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace tessera {

namespace {

constexpr std::string_view white_space = " \t\r";

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

/// Counts the words of a line, such as the corners of a face.
std::size_t count_words(std::string_view list) {
    std::size_t count = 0;
    bool after_space = true;
    for (const char c : list) {
        count += after_space && !is_space(c);
        after_space = is_space(c);
    }
    return count;
}

bool is_number_character(char c) {
    return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E';
}

/// Counts the numbers of a line; 0 if a character cannot be part of a number ("nan", "1,5").
std::size_t count_numbers(std::string_view list) {
    const bool is_plain =
        std::all_of(list.begin(), list.end(), [](char c) { return is_number_character(c) || is_space(c); });
    return is_plain ? count_words(list) : 0;
}

/// Returns the text before a "#" that is not part of a number such as "1.#IND".
std::string_view without_comment(std::string_view list) {
    std::size_t at = list.find('#');
    while (at != std::string_view::npos && at > 0 && list[at - 1] == '.')
        at = list.find('#', at + 1);
    return list.substr(0, at);
}

/// Returns whether a list has a NaN or infinite number. Throws std::runtime_error if it is not a list of `needed`
/// numbers or more. tinyobjloader would read an invalid number as 0.
bool has_non_finite(std::string_view list, std::size_t needed, std::size_t line) {
    list = without_comment(list);
    if (count_numbers(list) >= needed)
        return false;
    bool is_broken = false;
    std::size_t count = 0;
    while (true) {
        list.remove_prefix(std::min(list.find_first_not_of(white_space), list.size()));
        if (list.empty())
            break;
        const std::string_view word = list.substr(0, list.find_first_of(white_space));
        list.remove_prefix(word.size());
        const bool is_word = is_non_finite_word(word);
        if (!is_word && count_numbers(word) != 1)
            break;
        is_broken = is_broken || is_word;
        ++count;
    }
    if (!is_broken || count < needed || !list.empty())
        throw std::runtime_error("line " + std::to_string(line) + ": not a list of " + std::to_string(needed) +
                                 " numbers or more");
    return is_broken;
}

constexpr std::size_t max_unknown = 20; // keywords that are listed; a file of another format may have any number

void scan_line(ObjScan& scan, std::string_view name, std::string_view rest, std::size_t line) {
    const auto count = [&](std::size_t& items, std::vector<std::size_t>& broken, std::size_t numbers) {
        if (has_non_finite(rest, numbers, line))
            broken.push_back(items);
        ++items;
    };
    if (name == "v") {
        count(scan.positions, scan.broken_positions, 3);
        scan.colors += count_numbers(rest) >= 6;
    } else if (name == "vn") {
        count(scan.normals, scan.broken_normals, 3);
    } else if (name == "vt") {
        count(scan.uvs, scan.broken_uvs, 1);
    } else if (name == "f") {
        const std::size_t corners = std::max<std::size_t>(count_words(rest), 2);
        scan.triangles += corners - 2;
        scan.polygons += corners > 3;
    } else if (!name.empty() && name.front() != '#' && name != "g" && name != "o" && name != "s" &&
               name != "usemtl" && name != "mtllib") {
        const auto known = scan.unknown.find(name);
        if (known != scan.unknown.end())
            ++known->second;
        else if (scan.unknown.size() < max_unknown)
            scan.unknown.emplace(name.substr(0, 20), 1);
    }
}

/// Returns whether a line continues on the next one: it ends in a backslash and is no comment.
bool is_continued(std::string_view line) {
    const std::size_t first = line.find_first_not_of(white_space);
    return line.ends_with('\\') && line[first] != '#';
}

bool next_line(std::istream& stream, std::string& line) {
    if (!std::getline(stream, line))
        return false;
    if (line.ends_with('\r'))
        line.pop_back();
    return true;
}

std::string_view trim(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(white_space), text.size()));
    return text.substr(0, text.find_last_not_of(white_space) + 1);
}

} // namespace

ObjScan scan_obj(std::istream& stream) {
    ObjScan scan;
    std::string text, material;
    for (std::size_t line = 1; next_line(stream, text); ++line) {
        if (is_continued(text)) {
            scan.has_continuation = true;
            break;
        }
        std::string_view rest = text;
        rest.remove_prefix(std::min(rest.find_first_not_of(white_space), rest.size()));
        const std::string_view name = rest.substr(0, rest.find_first_of(white_space));
        rest.remove_prefix(name.size());
        scan_line(scan, name, rest, line);
        if (name == "usemtl")
            material = trim(rest);
        else if (name == "mtllib")
            scan.libraries.emplace_back(trim(rest));
        else if (name == "f" && (scan.materials.empty() || scan.materials.back() != material) &&
                 std::ranges::find(scan.materials, material) == scan.materials.end())
            scan.materials.push_back(material);
    }
    stream.clear();
    stream.seekg(0);
    return scan;
}

std::string join_lines(std::istream& stream) {
    std::string result, line, joined;
    std::size_t continued = 0;
    while (next_line(stream, line)) {
        joined += line;
        const bool continues = is_continued(joined);
        if (continues) {
            joined.back() = ' ';
            ++continued;
            continue;
        }
        result += joined + std::string(continued + 1, '\n');
        joined.clear();
        continued = 0;
    }
    return result + joined + "\n";
}

} // namespace tessera
