#include "app/commands/commands.h"
#include "app/experiment/stability.h"
#include "embedded/gallery_pictures.h"
#include "embedded/stability_results.h"
#include "render/io/picture_formats.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

namespace tessera {

namespace {

RgbImage picture_of(const std::string& name) {
    for (const EmbeddedFile& file : gallery_pictures) {
        if (file.name != name + ".jpg")
            continue;
        const ByteImage bytes = parse_jpeg(file.text(), [] { return true; });
        RgbImage image(bytes.width, bytes.height);
        for (std::size_t i = 0; i < image.size(); ++i)
            image.data()[i] = Rgb(bytes.rgb[3 * i], bytes.rgb[3 * i + 1], bytes.rgb[3 * i + 2]) / 255.0f;
        return image;
    }
    return {};
}

/// The cells of a table's line, without stars and links.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line.substr(1));
    for (std::string cell; std::getline(in, cell, '|');) {
        if (const std::size_t link = cell.find("]("); link != cell.npos)
            cell = cell.substr(0, link);
        std::erase_if(cell, [](char c) { return c == '*' || c == '['; });
        const std::size_t begin = cell.find_first_not_of(' '), end = cell.find_last_not_of(' ');
        cells.push_back(begin == cell.npos ? "" : cell.substr(begin, end - begin + 1));
    }
    return cells;
}

/// The first table of the suite's report: a line of names, and one a scene.
const std::vector<std::vector<std::string>>& verdicts() {
    static const std::vector<std::vector<std::string>> table = [] {
        std::vector<std::vector<std::string>> lines;
        std::istringstream in{std::string(stability_results)};
        for (std::string line; std::getline(in, line);) {
            if (line.starts_with("| ") && !line.starts_with("| ---"))
                lines.push_back(cells_of(line));
            else if (lines.size() > 1 && line.empty())
                break;
        }
        return lines;
    }();
    return table;
}

/// Adds what the suite has found of a scene, or of the values that it was varied by.
void add_verdicts(GalleryEntry& entry) {
    const auto& table = verdicts();
    for (std::size_t i = 1; i < table.size(); ++i) {
        const std::vector<std::string>& row = table[i];
        if (row.size() != table[0].size() || !(row[0] == entry.title || row[0].starts_with(entry.title + "-")))
            continue;
        std::string line = row[0] + ":";
        for (std::size_t column = 1; column < row.size(); ++column) {
            const std::string& name = table[0][column];
            if (name == "pr" || name == "gpt-weighted" || name == "gpr-weighted")
                line += fmt::format("  {} {}", name, row[column]);
        }
        entry.help += "\n" + line;
        const bool is_worse = !row.back().starts_with("ok");
        if (entry.verdict.empty() || is_worse)
            entry.verdict = "G-PR " + row.back();
        entry.is_worse = entry.is_worse || is_worse;
    }
}

} // namespace

std::vector<GalleryEntry> gallery() {
    std::vector<GalleryEntry> entries;
    entries.push_back({"cornell-box",
                       "The scene within the program, which the viewer begins with.",
                       "",
                       false,
                       {},
                       picture_of("cornell-box")});
    for (const std::filesystem::path& file : built_in_stability_scenes()) {
        const std::string name = file.stem().string();
        GalleryEntry entry{name, known_failure(file), "", false, file, picture_of(name)};
        entry.help += "\nError at equal time over that of PT, as measured last:";
        add_verdicts(entry);
        entries.push_back(std::move(entry));
    }
    return entries;
}

} // namespace tessera
