#include "ui/inspection_settings.h"

#include "ui/path_overlay.h"

#include <limits>

namespace tessera {

namespace {

using nlohmann::ordered_json;

/// "sample", if it is a pixel of what a pane shows.
void add_sample(ordered_json& json, const std::optional<SampleChoice>& sample, const ViewerState& state) {
    const PaneState* pane = sample ? state.pane_in(sample->slot) : nullptr;
    if (!pane || (sample->origin && !is_on_show(sample->origin->generation, state)))
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
    choice.slot = state.panes[static_cast<std::size_t>(pane - 1)].slot;
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
    slow.frames = on; // the picture lies as it did before the slow motion
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
    if (slow.active) // else it begins where the mouse is
        add_sample(json["slow_motion"], slow.sample, state);
}

void read_inspection(const JsonFields& fields, ViewerState& state) {
    if (fields.has("inspector"))
        read_inspector(fields.object("inspector"), state);
    if (fields.has("slow_motion"))
        read_slow_motion(fields.object("slow_motion"), state);
}

} // namespace tessera
