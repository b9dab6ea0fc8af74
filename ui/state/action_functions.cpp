#include "render/inspect/inspection.h"
#include "ui/state/actions.h"
#include "ui/state/words.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>

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

void next_component(ViewerState& state) {
    int components = 0;
    for (const PaneState& pane : state.panes)
        if (pane.snapshot && pane.snapshot->images)
            components = std::max(components, static_cast<int>(pane.snapshot->images->components.size()));
    const std::shared_ptr<const int>& shown = state.companions.component;
    const int next = shown ? *shown + 1 : 0;
    state.companions.component = next < components ? std::make_shared<const int>(next) : nullptr;
}

void toggle_denoiser(ViewerState& state, int pane) {
    PaneSettings& settings = state.panes[pane].settings;
    const Norm denoiser = has_gradients(settings.render.method) ? Norm::guided : Norm::smoothed;
    settings.reconstruction.norm = denoises(applied_norm(settings)) ? Norm::none : denoiser;
    state.linked = state.linked && state.panes.size() == 1;
}

void compare_reconstructions(ViewerState& state) {
    PaneSettings shown = state.active().settings;
    if (!has_gradients(shown.render.method))
        shown.render.method = Method::gpr;
    shown.buffer = Buffer::reconstruction;
    shown.comparison = {};
    state.linked = false; // linked panes have the same reconstruction
    state.layout.alone = false;
    state.set_pane_count(most_panes);
    constexpr Norm norms[] = {Norm::none, Norm::l1, Norm::weighted, Norm::guided};
    for (std::size_t i = 0; i < std::size(norms); ++i) {
        state.panes[i].settings = shown;
        state.panes[i].settings.reconstruction.norm = norms[i];
    }
    state.active_pane = most_panes - 1;
}

void step_exposure(ViewerState& state, float stops) {
    state.display.tone.exposure =
        std::clamp(state.display.tone.exposure + stops, ranges::exposure.low(), ranges::exposure.high());
}

void add_bookmark(ViewerState& state) {
    if (!state.scene)
        return;
    state.bookmarks.views.push_back({state.camera.camera(), state.camera.distance()});
    state.bookmarks.current = static_cast<int>(state.bookmarks.views.size()) - 1;
    state.tell("Bookmark " + std::to_string(state.bookmarks.views.size()) +
               " added. F7 moves the camera to the next bookmark.");
}

void next_bookmark(ViewerState& state) {
    if (state.bookmarks.views.empty())
        return state.tell("There are no bookmarks. Shift+F7 adds one for this view.");
    state.bookmarks.current = (state.bookmarks.current + 1) % static_cast<int>(state.bookmarks.views.size());
    const Bookmark& to = state.bookmarks.views[state.bookmarks.current];
    state.camera.put(to.camera, to.distance);
}

void forget_bookmark(ViewerState& state) {
    if (state.bookmarks.current < 0)
        return;
    state.tell("Bookmark " + std::to_string(state.bookmarks.current + 1) + " deleted.");
    state.bookmarks.views.erase(state.bookmarks.views.begin() + state.bookmarks.current);
    state.bookmarks.current =
        std::min(state.bookmarks.current, static_cast<int>(state.bookmarks.views.size()) - 1);
}

void next_pane(ViewerState& state) {
    state.active_pane = (state.active_pane + 1) % static_cast<int>(state.panes.size());
}

void next_grid(ViewerState& state) {
    const std::size_t count = state.panes.size();
    state.set_pane_count(count == 1 ? 2 : count == 2 ? 4 : 1);
}

void step_pass(ViewerState& state) {
    state.rendering.paused = true;
    ++state.wishes.steps;
}

void step_ui_scale(ViewerState& state, float by) {
    state.layout.set_ui_scale(std::round(state.layout.ui_scale() * 4) / 4 + by);
}

void next_tone(ViewerState& state) {
    state.display.tone.curve = static_cast<Tone::Curve>(state.display.tone.curve == Tone::Curve::srgb ? 1 : 0);
}

void toggle_charts(ViewerState& state) {
    state.layout.show_charts = !state.layout.show_charts;
    state.layout.large_charts = state.layout.large_charts && state.layout.show_charts;
}

void toggle_inspector(ViewerState& state) {
    state.set_inspector(!state.inspector.active);
}

void open_sample_form(ViewerState& state) {
    SampleForm& form = state.layout.sample_form;
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
