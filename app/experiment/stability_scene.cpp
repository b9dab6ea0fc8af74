#include "app/cli/embedded_file.h"
#include "app/cli/terminal.h"
#include "app/experiment/stability.h"
#include "embedded/stability_files.h"
#include "render/io/files.h"
#include "render/load/mitsuba_xml.h"
#include "render/settings/settings.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <system_error>

#include <fmt/core.h>

namespace tessera {

namespace {

namespace fs = std::filesystem;

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first == text.npos ? "" : text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// Returns the words of the text on one line.
std::string folded(const std::string& text) {
    std::istringstream words(text);
    std::string line;
    for (std::string word; words >> word;)
        line += (line.empty() ? "" : " ") + word;
    return line;
}

/// Returns the text of a comment "<!-- KEY: TEXT -->"; empty: there is none.
std::string comment_of(const std::string& xml, const std::string& key) {
    const std::string begin = "<!-- " + key + ":";
    const std::size_t found = xml.find(begin);
    if (found == xml.npos)
        return "";
    const std::size_t from = found + begin.size();
    return folded(xml.substr(from, xml.find("-->", from) - from));
}

/// Parses "NAME = VALUE, VALUE" into one set of variables for each value. An empty text gives one empty set.
std::vector<SceneVariables> variants_of(const std::string& text, const fs::path& file) {
    if (text.empty())
        return {{}};
    const std::size_t equals = text.find('=');
    std::vector<SceneVariables> variants;
    std::istringstream values(equals == text.npos ? "" : text.substr(equals + 1));
    for (std::string value; std::getline(values, value, ',');)
        variants.push_back({{trimmed(text.substr(0, equals)), trimmed(value)}});
    if (variants.empty())
        throw BadInput(
            fmt::format("{}: <!-- vary: {} -->: must be NAME = VALUE, VALUE, ...", file.string(), text));
    return variants;
}

/// Parses a text such as "100000 spp, 3 seeds, 16x16 pixels".
StabilityNeeds needs_of(const std::string& text, const fs::path& file) {
    StabilityNeeds needs;
    std::istringstream list(text);
    for (std::string need; std::getline(list, need, ',');) {
        int a = 0, b = 0, end = 0;
        const auto is = [&](const char* form) {
            end = 0;
            std::sscanf(need.c_str(), form, &a, &end);
            return end == static_cast<int>(need.size()) && a > 0;
        };
        if (is(" %d spp%n"))
            needs.spp = a;
        else if (is(" %d seeds%n"))
            needs.seeds = a;
        else if (std::sscanf(need.c_str(), " %dx%d pixels%n", &a, &b, &end) == 2 &&
                 end == static_cast<int>(need.size()) && a > 0 && b > 0)
            needs.size = glm::ivec2(a, b);
        else
            throw BadInput(
                fmt::format("{}: <!-- needs: {} -->: must be N spp, N seeds, WxH pixels, or some of these",
                            file.string(), text));
    }
    return needs;
}

/// Returns the folder assets/stability in this folder or its nearest parent that has one; empty: none has.
std::optional<fs::path> stability_folder(const fs::path& from) {
    for (fs::path folder = from;; folder = folder.parent_path()) {
        if (fs::is_directory(folder / "assets/stability"))
            return folder / "assets/stability";
        if (folder == folder.root_path() || folder.empty())
            return {};
    }
}

/// Returns the program's cache folder, by the XDG base directory specification.
fs::path cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    if (cache && *cache == '/')
        return fs::path(cache) / "tessera";
    return (home && *home ? fs::path(home) / ".cache" : fs::temp_directory_path()) / "tessera";
}

} // namespace

void unpack_stability_scenes(const fs::path& folder) {
    for (const EmbeddedFile& file : stability_files) {
        const fs::path path = folder / file.name;
        fs::create_directories(path.parent_path());
        write_text(path, file.text());
    }
}

std::vector<StabilityScene> stability_scenes(const std::vector<fs::path>& files) {
    std::vector<StabilityScene> scenes;
    for (const fs::path& file : files) {
        check_scene_file(file);
        std::ifstream in(file, std::ios::binary);
        const std::string xml{std::istreambuf_iterator<char>(in), {}};
        const StabilityNeeds needs =
            needs_of(comment_of(xml, "needs"), file); // g++ 12 frees twice if a function throws within braces
        for (const SceneVariables& variables : variants_of(comment_of(xml, "vary"), file)) {
            const int depth = std::min(load_mitsuba_xml(file, variables).description.max_depth, most_edges);
            scenes.push_back({{file, variables, {}}, depth, comment_of(xml, "fails"), needs});
        }
    }
    return scenes;
}

std::string known_failure(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string xml{std::istreambuf_iterator<char>(in), {}};
    return comment_of(xml, "fails");
}

std::vector<fs::path> built_in_stability_scenes() {
    std::error_code ignored;
    auto folder = stability_folder(fs::current_path());
    if (!folder)
        folder = stability_folder(fs::read_symlink("/proc/self/exe", ignored).parent_path());
    if (!folder) {
        folder = cache_folder() / "stability";
        unpack_stability_scenes(*folder);
    }
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(*folder))
        if (entry.path().extension() == ".xml")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace tessera
