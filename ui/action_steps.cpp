#include "ui/action_steps.h"

#include "ui/words.h"

#include <cmath>
#include <iterator>

namespace tessera {

void set_buffer(ViewerState& state, Buffer buffer) {
    for (PaneState& pane : state.panes)
        pane.settings.buffer = buffer;
}

void step_method(ViewerState& state, int step) {
    constexpr int count = static_cast<int>(std::size(all_methods));
    Method& method = state.active().settings.render.method;
    method = all_methods[(static_cast<int>(method) + step + count) % count];
}

void step_tile(ViewerState& state, int step) {
    int& tile = state.active().settings.render.tile;
    tile = std::clamp(tile + step, 1, 16);
    state.share_settings();
}

void step_exposure(ViewerState& state, float stops) {
    state.tone.exposure = std::clamp(state.tone.exposure + stops, ranges::exposure.low(), ranges::exposure.high());
}

void next_pane(ViewerState& state) {
    state.active_pane = (state.active_pane + 1) % static_cast<int>(state.panes.size());
}

void next_grid(ViewerState& state) {
    const std::size_t count = state.panes.size();
    state.set_pane_count(count == 1 ? 2 : count == 2 ? 4 : 1);
}

void step_pass(ViewerState& state) {
    state.paused = true;
    ++state.steps;
}

void step_ui_scale(ViewerState& state, float by) {
    state.set_ui_scale(std::round(state.ui_scale() * 4) / 4 + by);
}

void next_tone(ViewerState& state) {
    state.tone.curve = static_cast<Tone::Curve>((static_cast<int>(state.tone.curve) + 1) % 3);
}

void toggle_charts(ViewerState& state) {
    state.show_charts = !state.show_charts;
    state.large_charts = state.large_charts && state.show_charts;
}

void toggle_inspector(ViewerState& state) {
    state.set_inspector(!state.inspector.active);
}

void open_sample_form(ViewerState& state) {
    SampleForm& form = state.sample_form;
    form.seed = state.active().settings.render.seed;
    if (const auto& sample = state.inspector.sample) {
        form.pixel = sample->pixel;
        if (const auto& inspection = state.inspector.inspection)
            form.pass = inspection->pass;
        form.pass = sample->pass.value_or(form.pass);
        if (sample->origin)
            form.seed = sample->origin->settings.seed;
    }
    form.show = true;
}

void toggle_slow_motion(ViewerState& state) {
    state.set_slow_motion(!state.slow_motion.active);
}

void next_tile(ViewerState& state) {
    SlowMotion& slow = state.slow_motion;
    if (slow.tile)
        slow.start({slow.slot, slow.next_pixel(state.request_size()), {}});
}

void toggle_comparison(ViewerState& state, Comparison::Kind kind) {
    if (state.compared_with(state.active_pane) == state.active_pane)
        state.set_pane_count(2);
    Comparison::Kind& own = state.active().settings.comparison.kind;
    own = own == kind ? Comparison::Kind::off : kind;
}

} // namespace tessera
