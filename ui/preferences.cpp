#include "ui/preferences.h"

#include "render/load/json_text.h"
#include "render/load/temporary_file.h"
#include "ui/viewer_state.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

namespace tessera {

namespace {

using nlohmann::ordered_json;
constexpr int largest_window = 16384;

Preferences parse(const std::string& text) {
    const ordered_json json = ordered_json::parse(text);
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
    p.text_factor = std::clamp(json.value("text_factor", 1.0f), 0.25f, ViewerState::most_ui_scale);
    p.panel_width = std::clamp(json.value("panel_width", p.panel_width), ViewerState::least_panel_width,
                               ViewerState::most_panel_width);
    p.show_panel = json.value("panel", p.show_panel);
    p.show_statistics = json.value("statistics", p.show_statistics);
    p.show_charts = json.value("charts", p.show_charts);
    p.recent_scenes = json.value("recent_scenes", p.recent_scenes);
    p.recent_scenes.resize(std::min(p.recent_scenes.size(), Preferences::most_recent));
    return p;
}

} // namespace

void Preferences::add_recent(const std::filesystem::path& scene) {
    const std::string name = scene.lexically_normal().string();
    std::erase(recent_scenes, name);
    recent_scenes.insert(recent_scenes.begin(), name);
    recent_scenes.resize(std::min(recent_scenes.size(), most_recent));
}

std::filesystem::path preferences_file() {
    const char* config = std::getenv("XDG_CONFIG_HOME");
    const char* home = std::getenv("HOME");
    if (config && *config == '/') // a relative one is to be ignored, as the XDG specification says
        return std::filesystem::path(config) / "tessera" / "viewer.json";
    return home && *home ? std::filesystem::path(home) / ".config" / "tessera" / "viewer.json"
                         : std::filesystem::path();
}

Preferences read_preferences(const std::filesystem::path& file, std::string& note) {
    std::ifstream stream(file, std::ios::binary);
    if (file.empty() || !stream)
        return {};
    try {
        return parse(std::string(std::istreambuf_iterator<char>(stream), {}));
    } catch (const std::exception& error) {
        note = file.string() + " is ignored, as it is broken: " + error.what();
        return {};
    }
}

void write_preferences(const std::filesystem::path& file, const Preferences& p) {
    std::filesystem::create_directories(file.parent_path());
    ordered_json json{{"window", {p.window.size.x, p.window.size.y}},
                      {"maximised", p.window.maximised},
                      {"panes", p.panes},
                      {"theme", p.theme == Theme::light ? "light" : "dark"},
                      {"text_factor", p.text_factor},
                      {"panel_width", p.panel_width},
                      {"panel", p.show_panel},
                      {"statistics", p.show_statistics},
                      {"charts", p.show_charts},
                      {"recent_scenes", p.recent_scenes}};
    if (p.window.position)
        json["position"] = {p.window.position->x, p.window.position->y};
    write_text(file, to_text(json, 2) + "\n");
}

} // namespace tessera
