#include "app/load_notes.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace tessera {

namespace {

constexpr std::size_t most_named = 3; // places after the first

std::string place(const FilePosition& where, const FilePosition& first) {
    return where.file == first.file && where.line > 0 ? fmt::format("{}:{}", where.line, where.column)
                                                      : where.to_string();
}

std::string line_of(const std::vector<const LoadNote*>& same) {
    const FilePosition& first = same.front()->where;
    std::string line = first.to_string() + ": " + same.front()->text;
    if (same.size() == 1)
        return line;
    std::vector<std::string> places;
    for (std::size_t i = 1; i < std::min(same.size(), most_named + 1); ++i)
        places.push_back(place(same[i]->where, first));
    line += fmt::format(" (also at {}", fmt::join(places, ", "));
    const std::size_t unnamed = same.size() - 1 - places.size();
    if (unnamed > 0)
        line += fmt::format(" and {} more place{}", unnamed, unnamed == 1 ? "" : "s");
    return line + ")";
}

} // namespace

std::vector<std::string> group_notes(const std::vector<LoadNote>& notes) {
    std::map<std::string_view, std::size_t> group_of;
    std::vector<std::vector<const LoadNote*>> groups;
    for (const LoadNote& note : notes) {
        const auto [found, is_new] = group_of.emplace(note.text, groups.size());
        if (is_new)
            groups.emplace_back();
        groups[found->second].push_back(&note);
    }
    std::vector<std::string> lines;
    for (const auto& group : groups)
        lines.push_back(line_of(group));
    return lines;
}

} // namespace tessera
