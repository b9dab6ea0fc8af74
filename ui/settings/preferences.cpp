#include "ui/settings/preferences.h"

#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/io/json_text.h"
#include "ui/state/file_names.h"
#include "ui/state/viewer_state.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

namespace tessera {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
constexpr int largest_window = 16384;

/// Returns the text of a file; empty if there is no such file. Throws std::exception if it cannot be read, such
/// as a folder or a dangling link.
std::optional<std::string> text_of(const fs::path& file) {
    std::error_code ignored;
    if (fs::symlink_status(file, ignored).type() == fs::file_type::not_found)
        return std::nullopt;
    return read_bytes(file);
}

Preferences parse(const std::string& text, const std::string& name) {
    const ordered_json json = JsonText(text, name).parse();
    Preferences p;
    const auto window = json.value("window", std::vector<int>{0, 0});
    if (window.size() == 2 && std::min(window[0], window[1]) >= 64 &&
        std::max(window[0], window[1]) <= largest_window)
        p.window.size = {window[0], window[1]};
    const auto position = json.value("position", std::vector<int>{});
    if (position.size() == 2)
        p.window.position = {position[0], position[1]};
    p.window.maximised = json.value("maximised", false);
    p.panes = std::clamp(json.value("panes", 0), 0, most_panes);
    p.theme = json.value("theme", "dark") == "light" ? Theme::light : Theme::dark;
    p.text_factor = std::clamp(json.value("text_factor", 1.0f), 0.25f, Layout::most_ui_scale);
    p.panel_width =
        std::clamp(json.value("panel_width", p.panel_width), Layout::least_panel_width, Layout::most_panel_width);
    p.show_panel = json.value("panel", p.show_panel);
    p.open_sections = json.value("open_sections", p.open_sections);
    p.show_statistics = json.value("statistics", p.show_statistics);
    p.show_charts = json.value("charts", p.show_charts);
    p.recent_scenes = json.value("recent_scenes", p.recent_scenes);
    p.recent_scenes.resize(std::min(p.recent_scenes.size(), Preferences::most_recent));
    return p;
}

enum class Condition { fine, broken, unreadable };

Preferences read(const fs::path& file, std::string& note, Condition& condition) {
    condition = Condition::unreadable;
    try {
        const std::optional<std::string> text = text_of(file);
        condition = Condition::broken;
        Preferences preferences = text ? parse(*text, file.filename().string()) : Preferences{};
        condition = Condition::fine;
        return preferences;
    } catch (const std::exception& error) {
        note = file.string() + " is ignored, as it " +
               (condition == Condition::broken ? "is broken: " : "cannot be read: ") + message_of(error);
        return {};
    }
}

} // namespace

void Preferences::add_recent(const fs::path& scene) {
    const std::string name = scene.lexically_normal().string();
    std::erase(recent_scenes, name);
    recent_scenes.insert(recent_scenes.begin(), name);
    recent_scenes.resize(std::min(recent_scenes.size(), most_recent));
}

fs::path preferences_file() {
    const char* config = std::getenv("XDG_CONFIG_HOME");
    const char* home = std::getenv("HOME");
    if (config && *config == '/') // the XDG specification says that a relative path is ignored
        return fs::path(config) / "tessera" / "viewer.json";
    return home && *home ? fs::path(home) / ".config" / "tessera" / "viewer.json" : fs::path();
}

Preferences read_preferences(const fs::path& file, std::string& note) {
    Condition ignored;
    return read(file, note, ignored);
}

void write_preferences(const fs::path& file, const Preferences& p) {
    fs::create_directories(file.parent_path());
    ordered_json json{{"window", {p.window.size.x, p.window.size.y}},
                      {"maximised", p.window.maximised},
                      {"panes", p.panes},
                      {"theme", p.theme == Theme::light ? "light" : "dark"},
                      {"text_factor", p.text_factor},
                      {"panel_width", p.panel_width},
                      {"panel", p.show_panel},
                      {"open_sections", p.open_sections},
                      {"statistics", p.show_statistics},
                      {"charts", p.show_charts},
                      {"recent_scenes", p.recent_scenes}};
    if (p.window.position)
        json["position"] = {p.window.position->x, p.window.position->y};
    write_text(fs::weakly_canonical(file), to_text(json, 2) + "\n"); // writes to a link's target
}

LoadedPreferences claim_preferences(const fs::path& file) {
    LoadedPreferences kept;
    Condition condition;
    kept.preferences = read(file, kept.note, condition);
    if (condition == Condition::fine)
        return kept;
    std::error_code failed;
    const fs::path target = fs::canonical(file, failed); // renames a link's target
    const fs::path renamed = unused_name(target.string() + ".broken");
    if (condition == Condition::broken && !failed)
        fs::rename(target, renamed, failed);
    kept.can_be_replaced = condition == Condition::broken && !failed;
    kept.note += kept.can_be_replaced ? "; it is renamed to " + renamed.string()
                                      : "; it stays unchanged, and preferences are not saved";
    return kept;
}

LoadedPreferences store_preferences(const fs::path& file, Preferences preferences,
                                    const std::vector<std::string>& opened) {
    LoadedPreferences kept = claim_preferences(file);
    if (kept.note.empty()) // keeps scenes that other viewers have added
        preferences.recent_scenes = std::move(kept.preferences.recent_scenes);
    for (const std::string& scene : opened)
        preferences.add_recent(scene);
    kept.preferences = std::move(preferences);
    try {
        if (kept.can_be_replaced)
            write_preferences(file, kept.preferences);
    } catch (const std::exception&) { // a failure, such as a full disk, is not reported
    }
    return kept;
}

} // namespace tessera
