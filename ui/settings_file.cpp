#include "ui/settings_file.h"

#include "render/load/camera_file.h"
#include "render/method/settings_table.h"
#include "ui/named_settings.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace tessera {

namespace {

using nlohmann::ordered_json;

constexpr const char* bases[] = {"pane", "scene", "custom"};
constexpr const char* curves[] = {"srgb", "gamma", "filmic"};
constexpr const char* comparisons[] = {"off", "wipe", "difference"};
constexpr const char* shares[] = {"time", "spp"};

template <class Enum, std::size_t count>
const char* word(const char* const (&words)[count], Enum value) {
    return words[static_cast<std::size_t>(value)];
}

/// Sets `value` if `json` has `key`.
template <class Enum, std::size_t count>
void read(const ordered_json& json, const char* key, const char* const (&words)[count], Enum& value) {
    if (!json.contains(key))
        return;
    const std::string text = json.at(key).get<std::string>();
    const auto found = std::find(std::begin(words), std::end(words), text);
    if (found == std::end(words))
        throw std::invalid_argument(std::string(key) + " is \"" + text + "\", which there is not");
    value = static_cast<Enum>(found - std::begin(words));
}
template <class Number>
void read(const ordered_json& json, const char* key, double least, double most, Number& value) {
    if (!json.contains(key))
        return;
    const auto number = json.at(key).get<double>();
    if (!(number >= least && number <= most))
        throw std::invalid_argument(std::string(key) + " is out of range");
    value = static_cast<Number>(number);
}
void read(const ordered_json& json, const char* key, bool& value) {
    if (json.contains(key))
        value = json.at(key).get<bool>();
}

ordered_json pane_json(const PaneSettings& pane) {
    ordered_json json{{"method", short_name(pane.render.method)},
                      {"buffer", short_name(pane.buffer)},
                      {"norm", to_string(pane.reconstruction.norm)},
                      {"alpha", pane.reconstruction.alpha},
                      {"comparison", word(comparisons, pane.comparison.kind)},
                      {"compare_with", pane.comparison.with + 1},
                      {"seed", pane.render.seed}};
    for (const Setting& setting : all_settings())
        json["settings"][std::string(setting.id)] = setting.text(pane.render);
    return json;
}

PaneSettings read_pane(const ordered_json& json, PaneSettings pane) {
    if (json.contains("method")) {
        const auto method = method_from_name(json.at("method").get<std::string>());
        if (!method)
            throw std::invalid_argument("method is none of pt, pr, gpt, gpr");
        pane.render.method = *method;
    }
    if (json.contains("buffer"))
        pane.buffer = buffer_named(json.at("buffer").get<std::string>());
    if (json.contains("norm")) {
        const auto norm = norm_from_name(json.at("norm").get<std::string>());
        if (!norm)
            throw std::invalid_argument("there is no such norm");
        pane.reconstruction.norm = *norm;
    }
    read(json, "alpha", 0.001, 10, pane.reconstruction.alpha);
    read(json, "comparison", comparisons, pane.comparison.kind);
    read(json, "compare_with", 0, most_panes, pane.comparison.with);
    if (json.contains("compare_with"))
        --pane.comparison.with;
    if (json.contains("seed"))
        pane.render.seed = json.at("seed").get<std::uint64_t>();
    const ordered_json settings = json.value("settings", ordered_json::object());
    for (const auto& [id, value] : settings.items())
        setting_named(id).set_text(pane.render, value.get<std::string>());
    return pane;
}

/// All that is read before anything is set.
struct Read {
    std::vector<PaneSettings> panes;
    std::optional<Camera> camera;
    SizeChoice size;
    Tone tone;
    Pace pace;
    bool linked, mark_negative;
};

void read_display(const ordered_json& json, Read& read_here) {
    const ordered_json none = ordered_json::object();
    const ordered_json size = json.value("size", none), tone = json.value("tone", none),
                       pace = json.value("pace", none);
    read(size, "base", bases, read_here.size.base);
    read(size, "scale", 0.05, 2, read_here.size.scale);
    read(size, "width", 1, most_render_pixels_an_edge, read_here.size.custom.x);
    read(size, "height", 1, most_render_pixels_an_edge, read_here.size.custom.y);
    read(tone, "curve", curves, read_here.tone.curve);
    read(tone, "exposure", -10, 10, read_here.tone.exposure);
    read(tone, "gamma", 1, 4, read_here.tone.gamma);
    read(pace, "equal", shares, read_here.pace.equal);
    read(pace, "spp_limit", 0, 1 << 24, read_here.pace.spp_limit);
    read(pace, "seconds_limit", 0, 1e7, read_here.pace.seconds_limit);
    read(json, "linked", read_here.linked);
    read(json, "mark_negative", read_here.mark_negative);
}

Read read_all(const ViewerState& state, const std::string& text, const std::string& name) {
    const ordered_json json = ordered_json::parse(text);
    Read result{{}, {}, state.size, state.tone, state.pace, state.linked, state.mark_negative};
    if (json.contains("to_world")) {
        result.camera = parse_camera(text, name);
        return result;
    }
    if (!json.is_object() || !json.contains("panes"))
        throw std::invalid_argument("these are no settings of the viewer, and no camera");
    const ordered_json& panes = json.at("panes");
    if (!panes.is_array() || panes.empty() || panes.size() > most_panes)
        throw std::invalid_argument("there must be 1 to 4 panes");
    for (const ordered_json& pane : panes)
        result.panes.push_back(read_pane(pane, state.active().settings));
    if (json.contains("camera"))
        result.camera = parse_camera(json.at("camera").dump(2), name);
    read_display(json, result);
    return result;
}

} // namespace

std::string settings_json(const ViewerState& state) {
    ordered_json panes = ordered_json::array();
    for (const PaneState& pane : state.panes)
        panes.push_back(pane_json(pane.settings));
    const ordered_json json{
        {"panes", panes},
        {"linked", state.linked},
        {"size",
         {{"base", word(bases, state.size.base)},
          {"scale", state.size.scale},
          {"width", state.size.custom.x},
          {"height", state.size.custom.y}}},
        {"tone",
         {{"curve", word(curves, state.tone.curve)},
          {"exposure", state.tone.exposure},
          {"gamma", state.tone.gamma}}},
        {"pace",
         {{"equal", word(shares, state.pace.equal)},
          {"spp_limit", state.pace.spp_limit},
          {"seconds_limit", state.pace.seconds_limit}}},
        {"mark_negative", state.mark_negative},
        {"scene", state.scene_name},
        {"camera", ordered_json::parse(camera_json(state.camera.camera()))},
    };
    return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

void apply_settings_json(ViewerState& state, const std::string& text, const std::string& name) {
    Read read;
    try {
        read = read_all(state, text, name);
    } catch (const nlohmann::json::exception& error) {
        throw std::invalid_argument(name + ": " + error.what());
    } catch (const std::exception& error) {
        const std::string what = error.what();
        throw std::invalid_argument(what.find(name) == 0 ? what : name + ": " + what);
    }
    state.linked = false; // while panes are counted, which shares settings out
    if (!read.panes.empty())
        state.set_pane_count(static_cast<int>(read.panes.size()));
    for (std::size_t i = 0; i < read.panes.size(); ++i)
        state.panes[i].settings = read.panes[i];
    state.linked = read.linked;
    state.size = read.size;
    state.tone = read.tone;
    state.pace = read.pace;
    state.mark_negative = read.mark_negative;
    if (read.camera)
        state.camera.put(*read.camera);
}

void apply_settings_file(ViewerState& state, const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream)
        throw std::invalid_argument(file.string() + ": cannot be read");
    apply_settings_json(state, text, file.string());
}

} // namespace tessera
