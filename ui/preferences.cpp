#include "ui/preferences.h"

#include "ui/output_files.h"

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
        p.window_size = {window[0], window[1]};
    p.theme = json.value("theme", "dark") == "light" ? Theme::light : Theme::dark;
    if (json.contains("ui_scale"))
        p.ui_scale = std::clamp(json.at("ui_scale").get<float>(), 1.0f, 3.0f);
    p.show_panel = json.value("panel", p.show_panel);
    p.show_statistics = json.value("statistics", p.show_statistics);
    p.show_charts = json.value("charts", p.show_charts);
    p.recent_scenes = json.value("recent_scenes", p.recent_scenes);
    p.recent_scenes.resize(std::min(p.recent_scenes.size(), Preferences::most_recent));
    return p;
}

} // namespace

void Preferences::add_recent(const std::filesystem::path& scene) {
    const std::string name = std::filesystem::absolute(scene).lexically_normal().string();
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
    ordered_json json{{"window", {p.window_size.x, p.window_size.y}},
                      {"theme", p.theme == Theme::light ? "light" : "dark"},
                      {"panel", p.show_panel},
                      {"statistics", p.show_statistics},
                      {"charts", p.show_charts},
                      {"recent_scenes", p.recent_scenes}};
    if (p.ui_scale)
        json["ui_scale"] = *p.ui_scale;
    write_text_file(file, json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

} // namespace tessera
