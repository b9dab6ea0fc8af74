#include "render/settings/settings_table.h"
#include "ui/settings/settings_file.h"
#include "ui/state/words.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/core.h>
#include <glm/vec2.hpp>

namespace tessera {

namespace {

/// A setting, with an action that follows when it is set.
struct Named {
    Setting setting;
    std::function<void()> on_set = [] {};
};

/// Values that functions of the state take, instead of members.
struct IndirectValues {
    int pane, panes, axis;
    bool inspector, slow_motion;
    float ui_scale;
    glm::ivec2 size{0};
};

Setting flag(std::string_view id, bool& value) {
    return {id, "", "", Setting::Switch{&value}};
}

template <class Enum>
Setting choice(std::string_view id, std::span<const SettingChoice> choices, Enum& value) {
    return {id, "", "", one_of(choices, value)};
}

Setting real(std::string_view id, float& value, float least, float most) {
    return {id, "", "", Setting::Real{&value, least, most, least, most}};
}

void add_pane_settings(std::vector<Named>& all, ViewerState& s) {
    PaneSettings& pane = s.active().settings;
    all.push_back({method_setting(pane.render.method)});
    for (const Setting& setting : shared_settings_of(pane))
        all.push_back({setting, [&s] { s.share_settings(); }});
    all.push_back({comparison_setting(pane.comparison.kind)});
}

void add_layout(std::vector<Named>& all, ViewerState& s, IndirectValues& values) {
    all.push_back({{"active", "", "", Setting::Whole{&values.pane, 1, static_cast<int>(s.panes.size())}},
                   [&] { s.active_pane = values.pane - 1; }});
    all.push_back({{"panes", "", "", Setting::Whole{&values.panes, 1, most_panes}},
                   [&] { s.set_pane_count(values.panes); }});
    all.push_back({flag("alone", s.layout.alone)});
    all.push_back({real("wipe", s.layout.wipe, ranges::share.low(), ranges::share.high())});
    all.push_back({flag("linked", s.linked)});
    all.push_back({flag("panel", s.layout.show_panel)});
    all.push_back({flag("statistics", s.layout.show_statistics)});
    all.push_back({choice("theme", words::themes, s.layout.theme)});
    all.push_back({real("ui_scale", values.ui_scale, Layout::least_ui_scale, Layout::most_ui_scale),
                   [&] { s.layout.set_ui_scale(values.ui_scale); }});
    all.push_back({flag("charts", s.layout.show_charts)});
    all.push_back({choice("chart", words::charts, s.layout.chart_kind)});
    all.push_back({flag("large_charts", s.layout.large_charts)});
    all.push_back({choice("charts_axis", words::chart_axes, values.axis),
                   [&] { s.layout.charts_by_spp = values.axis == 1; }});
}

void add_pictures(std::vector<Named>& all, ViewerState& s, IndirectValues& values) {
    all.push_back({flag("paused", s.rendering.paused)});
    for (const Setting& setting : settings_of(s.rendering.pace))
        all.push_back({setting});
    all.push_back({custom_size_setting(values.size),
                   [&] { s.rendering.size = {SizeChoice::Base::custom, 1, values.size}; }});
    for (const Setting& setting : settings_of(s.display.tone))
        all.push_back({setting});
    all.push_back({flag("magnifier", s.display.magnifier)});
    all.push_back({flag("tiles", s.display.show_tiles)});
    all.push_back({flag("mark_negative", s.display.mark_negative)});
    Setting spp = spp_setting(s.reference_making.spp, 2), method = method_setting(s.reference_making.method);
    spp.id = "reference_spp";
    method.id = "reference_method";
    all.push_back({spp});
    all.push_back({method});
}

void add_insides(std::vector<Named>& all, ViewerState& s, IndirectValues& values) {
    all.push_back({flag("inspector", values.inspector), [&] { s.set_inspector(values.inspector); }});
    all.push_back({choice("inspector_shows", words::directions, s.inspector.direction)});
    all.push_back({flag("slow_motion", values.slow_motion), [&] { s.set_slow_motion(values.slow_motion); }});
    all.push_back({flag("slow_motion_held", s.slow_motion.held)});
    all.push_back(
        {real("slow_motion_speed", s.slow_motion.speed, SlowMotion::least_speed, SlowMotion::most_speed)});
}

std::vector<Named> all_named(ViewerState& state, IndirectValues& values) {
    std::vector<Named> all;
    add_pane_settings(all, state);
    add_layout(all, state, values);
    add_pictures(all, state, values);
    add_insides(all, state, values);
    return all;
}

/// Returns the_reference for "reference", or the index for the number of a pane.
int compared_with(const std::string& value) {
    int pane = 0;
    if (value == "reference")
        return the_reference;
    Setting{"compare_with", "", "", Setting::Whole{&pane, 1, most_panes}}.set_text(value);
    return pane - 1;
}

} // namespace

Buffer buffer_named(const std::string& value) {
    for (Buffer buffer : all_buffers) {
        if (short_name(buffer) == value)
            return buffer;
    }
    if (value == "failed") // name in older settings files
        return Buffer::outcomes;
    throw std::invalid_argument("unknown buffer " + value);
}

void set_by_name(ViewerState& state, const std::string& name, const std::string& value) {
    PaneSettings& pane = state.active().settings;
    if (name == "buffer") {
        pane.buffer = buffer_named(value);
        return;
    }
    if (name == "compare_with") {
        pane.comparison.with = compared_with(value);
        return;
    }
    IndirectValues values{};
    std::string list = "buffer, compare_with";
    for (const Named& named : all_named(state, values)) {
        if (named.setting.id == name) {
            named.setting.set_text(value);
            return named.on_set();
        }
        list += fmt::format(", {}", named.setting.id);
    }
    throw std::invalid_argument(fmt::format("unknown setting {}; the settings are {}", name, list));
}

std::vector<Setting> settings_of(Pace& pace) {
    return {
        {"equal", "Compare at", "What is equal in all panes: render time or samples per pixel.",
         one_of(words::shares, pace.equal)},
        {"spp_limit", "Stop at spp", "Samples per pixel at which the panes stop. 0: no limit.",
         Setting::Whole{&pace.spp_limit, 0, most_spp}, pace.equal == Pace::Equal::spp || pace.spp_limit > 0},
        {"seconds_limit", "Stop at seconds",
         "Wall time of a pane's passes at which it stops, seconds. 0: no limit.",
         Setting::Seconds{&pace.seconds_limit, 0, most_seconds},
         pace.equal == Pace::Equal::time || pace.seconds_limit > 0},
    };
}

std::vector<Setting> settings_of(Tone& tone) {
    const float low = ranges::exposure.low(), high = ranges::exposure.high();
    return {
        {"tone", "Tone curve", "Maps radiance to brightness on the screen (Y).", one_of(words::tones, tone.curve)},
        {"exposure", "Exposure",
         "Exposure in stops. Each stop doubles the brightness on the screen, of gradients too.",
         Setting::Real{&tone.exposure, low, high, low, high, "%+.1f stops"}},
        {"difference_exposure", "Difference exposure",
         "Additional exposure of gradients and differences. F6 sets it automatically.",
         Setting::Real{&tone.difference_exposure, 2 * low, 2 * high, low, high, "%+.1f stops"}},
    };
}

Setting comparison_setting(Comparison::Kind& kind) {
    return {"comparison", "Active pane", "How the active pane is compared with another pane or the reference.",
            one_of(words::comparisons, kind)};
}

Setting size_base_setting(SizeChoice::Base& base) {
    return {"size", "Size", "Number of rendered pixels.", one_of(words::sizes, base)};
}

Setting custom_size_setting(glm::ivec2& size) {
    return size_setting(size, most_render_pixels_an_edge);
}

std::vector<Setting> shared_settings_of(PaneSettings& pane) {
    std::vector<Setting> all = settings_of(pane.render);
    for (const Setting& setting : settings_of(pane.reconstruction))
        all.push_back(setting);
    all.push_back(seed_setting(pane.render.seed));
    return all;
}

} // namespace tessera
