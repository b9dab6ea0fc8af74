#include "ui/settings/settings_file.h"

#include "render/io/json_text.h"
#include "render/io/text.h"
#include "render/scene/camera.h"
#include "render/settings/settings_table.h"
#include "ui/settings/json_fields.h"
#include "ui/state/words.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <vector>

namespace tessera {

namespace {

using nlohmann::ordered_json;

/// Returns the JSON key of a setting: its id, but "curve" for the tone curve, whose object is called "tone".
std::string key_of(const Setting& setting) {
    return setting.id == "tone" ? "curve" : std::string(setting.id);
}

void add(ordered_json& json, const Setting& setting) {
    json[key_of(setting)] = setting.json_value();
}

ordered_json json_of(const std::vector<Setting>& settings) {
    ordered_json json;
    for (const Setting& setting : settings)
        add(json, setting);
    return json;
}

ordered_json pane_json(PaneSettings pane) {
    ordered_json json;
    add(json, method_setting(pane.render.method));
    json["buffer"] = short_name(pane.buffer);
    for (const Setting& setting : settings_of(pane.reconstruction))
        add(json, setting);
    add(json, comparison_setting(pane.comparison.kind));
    json["compare_with"] = pane.comparison.with + 1;
    add(json, seed_setting(pane.render.seed));
    for (const Setting& setting : settings_of(pane.render))
        json["settings"][std::string(setting.id)] = setting.text();
    return json;
}

PaneSettings read_pane(const JsonFields& fields, PaneSettings pane) {
    fields.read(method_setting(pane.render.method));
    fields.read<std::string>("buffer", [&](const std::string& name) { pane.buffer = buffer_named(name); });
    for (const Setting& setting : settings_of(pane.reconstruction))
        fields.read(setting);
    fields.read(comparison_setting(pane.comparison.kind));
    fields.read("compare_with", {0, the_reference + 1}, pane.comparison.with);
    if (fields.has("compare_with"))
        --pane.comparison.with;
    fields.read(seed_setting(pane.render.seed));
    const JsonFields settings = fields.object("settings");
    const std::vector<Setting> known = settings_of(pane.render);
    for (const auto& [id, value] : settings.json().items())
        settings.read<std::string>(
            id, [&, id = id](const std::string& text) { setting_named(known, id).set_text(text); });
    return pane;
}

ordered_json ranges_json(const std::map<Buffer, ValueRange>& ranges) {
    ordered_json json = ordered_json::object();
    for (const auto& [buffer, range] : ranges)
        json[std::string(short_name(buffer))] = {
            {"low", range.low}, {"high", range.high}, {"logarithmic", range.logarithmic}};
    return json;
}

std::map<Buffer, ValueRange> read_ranges(const JsonFields& fields) {
    std::map<Buffer, ValueRange> ranges;
    for (const auto& [name, value] : fields.json().items()) {
        Buffer buffer{};
        try {
            buffer = buffer_named(name);
        } catch (const std::invalid_argument& error) {
            fields.fail(name, error.what());
        }
        const JsonFields ends = fields.object(name);
        ValueRange& range = ranges[buffer];
        ends.read("low", {0, 1e12}, range.low);
        ends.read("high", {0, 1e12}, range.high);
        ends.read("logarithmic", range.logarithmic);
        if (!(range.low < range.high) || (range.logarithmic && range.low <= 0))
            fields.fail(name, "the range of " + name + " needs low < high, and low > 0 if it is logarithmic");
    }
    return ranges;
}

/// Reads size, tone, pace and ranges, which are common to all panes.
void read_display(const JsonFields& fields, ViewerState& state) {
    const JsonFields size = fields.object("size"), tone = fields.object("tone"), pace = fields.object("pace");
    size.read("base", size_base_setting(state.rendering.size.base));
    size.read("scale", ranges::scale, state.rendering.size.scale);
    size.read("width", {1, most_render_pixels_an_edge}, state.rendering.size.custom.x);
    size.read("height", {1, most_render_pixels_an_edge}, state.rendering.size.custom.y);
    for (const Setting& setting : settings_of(state.display.tone))
        tone.read(key_of(setting), setting);
    for (const Setting& setting : settings_of(state.rendering.pace))
        pace.read(setting);
    fields.read("mark_negative", state.display.mark_negative);
    if (fields.has("ranges"))
        state.display.ranges = read_ranges(fields.object("ranges"));
}

/// Reads the view of the pictures, and the overlays and charts.
void read_view(const JsonFields& fields, ViewerState& state) {
    const JsonFields picture = fields.object("picture"), chart = fields.object("charts");
    float zoom = state.display.view.zoom();
    glm::vec2 center = state.display.view.center();
    picture.read("zoom", {double{ImageView::least_zoom}, double{ImageView::most_zoom}}, zoom);
    picture.read("x", ranges::share, center.x);
    picture.read("y", ranges::share, center.y);
    if (fields.has("picture"))
        state.set_view(ImageView(zoom, center));
    fields.read("wipe", ranges::share, state.layout.wipe);
    fields.read("alone", state.layout.alone);
    fields.read("tiles", state.display.show_tiles);
    fields.read("magnifier", state.display.magnifier);
    int axis = state.layout.charts_by_spp ? 1 : 0;
    chart.read("show", words::charts, state.layout.chart_kind);
    chart.read("against", words::chart_axes, axis);
    state.layout.charts_by_spp = axis == 1;
}

void read_panes(const JsonFields& fields, ViewerState& state) {
    if (!fields.has("panes"))
        fields.fail("", "this is neither a settings file of the viewer nor a camera file");
    const ordered_json& json = fields.json().at("panes");
    if (!json.is_array() || json.empty() || json.size() > most_panes)
        fields.fail("panes", "there must be 1 to 4 panes");
    std::vector<PaneSettings> panes;
    for (std::size_t i = 0; i < json.size(); ++i)
        panes.push_back(read_pane(fields.element(json, i, "panes"), state.active().settings));
    state.linked = false; // so that set_pane_count() does not copy settings between panes
    state.set_pane_count(static_cast<int>(panes.size()));
    for (std::size_t i = 0; i < panes.size(); ++i)
        state.panes[i].settings = panes[i];
    fields.read("active", {1, static_cast<double>(panes.size())}, state.active_pane);
    if (fields.has("active"))
        --state.active_pane;
}

void read_camera(const JsonFields& fields, const Camera& camera, ViewerState& state) {
    float distance = 0;
    fields.read("target_distance", {0, 1e12}, distance);
    state.camera.put(camera, distance);
}

void read_bookmarks(const JsonFields& fields, const JsonText& text, const std::string& name, ViewerState& state) {
    if (!fields.has("bookmarks"))
        return;
    const ordered_json& json = fields.json().at("bookmarks");
    if (!json.is_array())
        fields.fail("bookmarks", "bookmarks must be a list of cameras");
    state.bookmarks.views.clear();
    for (std::size_t i = 0; i < json.size(); ++i) {
        Bookmark bookmark;
        fields.element(json, i, "bookmarks").read("target_distance", {0, 1e12}, bookmark.distance);
        bookmark.camera = parse_camera(text.only("bookmarks/" + std::to_string(i) + "/camera"), name);
        state.bookmarks.views.push_back(bookmark);
    }
    state.bookmarks.current = static_cast<int>(state.bookmarks.views.size()) - 1;
}

/// Applies the fields of the file in turn. Throws LoadError at the first error; earlier fields are then applied.
void read_all(const std::string& file, const std::string& name, ViewerState& state) {
    const JsonText text(file, name);
    const ordered_json json = text.parse();
    JsonReading reading(text);
    const JsonFields fields(reading, json, "");
    if (fields.has("to_world"))
        return read_camera(fields, parse_camera(file, name), state);
    bool linked = state.linked;
    fields.read("linked", linked);
    read_panes(fields, state);
    state.linked = linked;
    if (fields.has("camera"))
        read_camera(fields, parse_camera(text.only("camera"), name), state);
    read_bookmarks(fields, text, name, state);
    read_display(fields, state);
    read_view(fields, state);
    read_inspection(fields, state);
    if (fields.has("space"))
        state.space.look_as(parse_camera(text.only("space"), name));
    fields.read<std::string>("reference", [&](const std::string& reference) {
        if (!state.companions.reference || state.companions.reference->name != reference)
            state.wishes.open_reference = reference;
    });
    fields.has("scene"); // marks the field as known; it only informs readers
    for (std::string& line : reading.unknown())
        state.add_message(Message::Kind::note, std::move(line));
}

ordered_json bookmarks_json(const ViewerState& state) {
    ordered_json all = ordered_json::array();
    for (const Bookmark& bookmark : state.bookmarks.views)
        all.push_back({{"camera", ordered_json::parse(camera_json(bookmark.camera))},
                       {"target_distance", bookmark.distance}});
    return all;
}

} // namespace

std::string settings_json(const ViewerState& state) {
    const ImageView view =
        state.slow_motion.view_before.value_or(state.display.view); // the view without slow motion
    ordered_json panes = ordered_json::array();
    for (const PaneState& pane : state.panes)
        panes.push_back(pane_json(pane.settings));
    Tone tone = state.display.tone;
    Pace pace = state.rendering.pace;
    ordered_json json{
        {"panes", panes},
        {"active", state.active_pane + 1},
        {"alone", state.layout.alone},
        {"linked", state.linked},
        {"size",
         {{"base", word(words::sizes, state.rendering.size.base)},
          {"scale", state.rendering.size.scale},
          {"width", state.rendering.size.custom.x},
          {"height", state.rendering.size.custom.y}}},
        {"tone", json_of(settings_of(tone))},
        {"ranges", ranges_json(state.display.ranges)},
        {"mark_negative", state.display.mark_negative},
        {"pace", json_of(settings_of(pace))},
        {"picture", {{"zoom", view.zoom()}, {"x", view.center().x}, {"y", view.center().y}}},
        {"wipe", state.layout.wipe},
        {"tiles", state.display.show_tiles},
        {"magnifier", state.display.magnifier},
        {"charts",
         {{"show", word(words::charts, state.layout.chart_kind)},
          {"against", word(words::chart_axes, state.layout.charts_by_spp ? 1 : 0)}}},
        {"scene", state.scene_info.name}, // informs readers; settings apply to any scene
        {"camera", ordered_json::parse(camera_json(state.camera.camera()))},
        {"target_distance", state.camera.distance()},
        {"bookmarks", bookmarks_json(state)},
    };
    add_inspection(json, state);
    if (state.space.has_direction)
        json["space"] = ordered_json::parse(camera_json(state.space.camera.camera()));
    if (state.companions.reference)
        json["reference"] = state.companions.reference->name;
    return to_text(json, 2) + "\n";
}

void apply_settings_json(ViewerState& state, const std::string& text, const std::string& name) {
    ViewerState next = state;
    read_all(text, name, next);
    state = std::move(next);
}

void apply_settings_file(ViewerState& state, const std::filesystem::path& file) {
    apply_settings_json(state, read_text(file), file.string());
}

namespace {

using nlohmann::ordered_json;

/// Adds the field "sample" if the sample belongs to a render that a pane shows.
void add_sample(ordered_json& json, const std::optional<SampleChoice>& sample, const ViewerState& state) {
    const PaneState* pane = sample ? state.pane_in(sample->slot) : nullptr;
    if (!pane || (sample->origin && !state.shows_request(sample->origin->generation)))
        return;
    json["sample"] = {{"pane", pane - state.panes.data() + 1}, {"x", sample->pixel.x}, {"y", sample->pixel.y}};
    if (sample->pass)
        json["sample"]["pass"] = *sample->pass;
}

std::optional<SampleChoice> read_sample(const JsonFields& fields, const ViewerState& state) {
    if (!fields.has("sample"))
        return std::nullopt;
    const JsonFields sample = fields.object("sample");
    int pane = state.active_pane + 1;
    SampleChoice choice;
    sample.read("pane", {1, static_cast<double>(state.panes.size())}, pane);
    sample.read("x", {0, most_render_pixels_an_edge - 1}, choice.pixel.x);
    sample.read("y", {0, most_render_pixels_an_edge - 1}, choice.pixel.y);
    if (sample.has("pass"))
        sample.read("pass", {0, std::numeric_limits<int>::max()}, choice.pass.emplace());
    choice.slot = state.panes[pane - 1].slot;
    return choice;
}

void read_inspector(const JsonFields& fields, ViewerState& state) {
    Inspector& inspector = state.inspector;
    bool on = inspector.active;
    fields.read("on", on);
    fields.read("shows", words::directions, inspector.direction);
    fields.read("follows", inspector.follows);
    if (const auto sample = read_sample(fields, state))
        inspector.choose(*sample);
    state.set_inspector(on);
}

void read_slow_motion(const JsonFields& fields, ViewerState& state) {
    SlowMotion& slow = state.slow_motion;
    bool on = slow.active;
    fields.read("on", on);
    state.set_slow_motion(on);
    slow.frames = on; // the view in the file is the one without slow motion
    fields.read("held", slow.held);
    fields.read("speed", {double{SlowMotion::least_speed}, double{SlowMotion::most_speed}}, slow.speed);
    if (const auto sample = read_sample(fields, state))
        slow.start(*sample);
}

} // namespace

void add_inspection(ordered_json& json, const ViewerState& state) {
    const Inspector& inspector = state.inspector;
    const SlowMotion& slow = state.slow_motion;
    json["inspector"] = {{"on", inspector.active},
                         {"shows", word(words::directions, inspector.direction)},
                         {"follows", inspector.follows}};
    add_sample(json["inspector"], inspector.sample, state);
    json["slow_motion"] = {{"on", slow.active}, {"held", slow.held}, {"speed", slow.speed}};
    if (slow.active) // otherwise the slow motion chooses a tile when it opens
        add_sample(json["slow_motion"], slow.sample, state);
}

void read_inspection(const JsonFields& fields, ViewerState& state) {
    if (fields.has("inspector"))
        read_inspector(fields.object("inspector"), state);
    if (fields.has("slow_motion"))
        read_slow_motion(fields.object("slow_motion"), state);
}

} // namespace tessera
