#include "ui/settings_file.h"

#include "render/load/camera_file.h"
#include "render/load/json_text.h"
#include "render/load/messages.h"
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

/// An object of the file, and where it stands in it. What is wrong with a field is told with its place.
class Fields {
public:
    Fields(const JsonText& text, const ordered_json& json, std::string path)
        : text_(text), json_(json), path_(std::move(path)) {
        if (!json.is_object())
            fail("", "this must be an object, {...}");
    }

    [[noreturn]] void fail(const std::string& key, const std::string& what) const {
        text_.fail_at(text_.place_of(path_ + key), what);
    }

    const ordered_json& json() const { return json_; }
    bool has(const char* key) const { return json_.contains(key); }
    /// Without fields where there is none of that name.
    Fields object(const std::string& key) const {
        static const ordered_json none = ordered_json::object();
        return {text_, json_.contains(key) ? json_.at(key) : none, path_ + key + "/"};
    }
    Fields element(const ordered_json& array, std::size_t i, const std::string& key) const {
        return {text_, array[i], path_ + key + "/" + std::to_string(i) + "/"};
    }

    template <class T>
    T get(const std::string& key) const {
        try {
            return json_.at(key).get<T>();
        } catch (const ordered_json::exception&) {
            fail(key, key + " is of the wrong kind: " + json_.at(key).type_name());
        }
    }
    /// `take` gets the value, and throws std::invalid_argument where it is no good.
    template <class T, class Take>
    void read(const std::string& key, Take take) const {
        if (!json_.contains(key))
            return;
        try {
            take(get<T>(key));
        } catch (const std::invalid_argument& error) {
            fail(key, error.what());
        }
    }
    template <class Enum, std::size_t count>
    void read(const std::string& key, const char* const (&words)[count], Enum& value) const {
        read<std::string>(key, [&](const std::string& text) {
            const auto found = std::find(std::begin(words), std::end(words), text);
            if (found == std::end(words))
                throw std::invalid_argument(key + " is \"" + text + "\", which there is not");
            value = static_cast<Enum>(found - std::begin(words));
        });
    }
    template <class Number>
    void read(const std::string& key, double least, double most, Number& value) const {
        read<double>(key, [&](double number) {
            if (!(number >= least && number <= most))
                throw std::invalid_argument(key + " is out of range");
            value = static_cast<Number>(number);
        });
    }
    void read(const std::string& key, bool& value) const {
        read<bool>(key, [&](bool on) { value = on; });
    }

private:
    const JsonText& text_;
    const ordered_json& json_;
    std::string path_; // of all its fields, before their names
};

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

PaneSettings read_pane(const Fields& fields, PaneSettings pane) {
    fields.read<std::string>("method", [&](const std::string& name) {
        const auto method = method_from_name(name);
        if (!method)
            throw std::invalid_argument("method is none of pt, pr, gpt, gpr");
        pane.render.method = *method;
    });
    fields.read<std::string>("buffer", [&](const std::string& name) { pane.buffer = buffer_named(name); });
    fields.read<std::string>("norm", [&](const std::string& name) {
        const auto norm = norm_from_name(name);
        if (!norm)
            throw std::invalid_argument("there is no such norm");
        pane.reconstruction.norm = *norm;
    });
    fields.read("alpha", 0.001, 10, pane.reconstruction.alpha);
    fields.read("comparison", comparisons, pane.comparison.kind);
    fields.read("compare_with", 0, the_reference + 1, pane.comparison.with);
    if (fields.has("compare_with"))
        --pane.comparison.with;
    fields.read<std::uint64_t>("seed", [&](std::uint64_t seed) { pane.render.seed = seed; });
    const Fields settings = fields.object("settings");
    for (const auto& [id, value] : settings.json().items())
        settings.read<std::string>(
            id, [&, id = id](const std::string& text) { setting_named(id).set_text(pane.render, text); });
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

void read_display(const Fields& fields, Read& read_here) {
    const Fields size = fields.object("size"), tone = fields.object("tone"), pace = fields.object("pace");
    size.read("base", bases, read_here.size.base);
    size.read("scale", 0.05, 2, read_here.size.scale);
    size.read("width", 1, most_render_pixels_an_edge, read_here.size.custom.x);
    size.read("height", 1, most_render_pixels_an_edge, read_here.size.custom.y);
    tone.read("curve", curves, read_here.tone.curve);
    tone.read("exposure", -10, 10, read_here.tone.exposure);
    tone.read("gamma", 1, 4, read_here.tone.gamma);
    pace.read("equal", shares, read_here.pace.equal);
    pace.read("spp_limit", 0, 1 << 24, read_here.pace.spp_limit);
    pace.read("seconds_limit", 0, 1e7, read_here.pace.seconds_limit);
    fields.read("linked", read_here.linked);
    fields.read("mark_negative", read_here.mark_negative);
}

Read read_all(const ViewerState& state, const std::string& file, const std::string& name) {
    const JsonText text(file, name);
    const ordered_json json = text.parse();
    Read result{{}, {}, state.size, state.tone, state.pace, state.linked, state.mark_negative};
    const Fields fields(text, json, "");
    if (fields.has("to_world")) {
        result.camera = parse_camera(file, name);
        return result;
    }
    if (!fields.has("panes"))
        fields.fail("", "these are no settings of the viewer, and no camera");
    const ordered_json& panes = json.at("panes");
    if (!panes.is_array() || panes.empty() || panes.size() > most_panes)
        fields.fail("panes", "there must be 1 to 4 panes");
    for (std::size_t i = 0; i < panes.size(); ++i)
        result.panes.push_back(read_pane(fields.element(panes, i, "panes"), state.active().settings));
    if (fields.has("camera"))
        result.camera = parse_camera(text.only("camera"), name);
    read_display(fields, result);
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
    const Read read = read_all(state, text, name);
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
        throw LoadError({file.string(), 0, 0}, "cannot be read");
    apply_settings_json(state, text, file.string());
}

} // namespace tessera
