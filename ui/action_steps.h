#pragma once

#include "ui/viewer_state.h"

#include <algorithm>

namespace tessera {

/// What the actions of the table do that takes more than a line.

void set_buffer(ViewerState& state, Buffer buffer); ///< in all panes
void step_method(ViewerState& state, int step);     ///< of the active pane
void step_tile(ViewerState& state, int step);
void step_exposure(ViewerState& state, float stops);
void step_pass(ViewerState& state);
void step_ui_scale(ViewerState& state, float by);
void next_pane(ViewerState& state);
void next_grid(ViewerState& state);
void next_tone(ViewerState& state);
void next_tile(ViewerState& state);     ///< of the slow motion
void toggle_charts(ViewerState& state); ///< hidden, they are not drawn large either
void toggle_inspector(ViewerState& state);
void open_sample_form(ViewerState& state); ///< with the sample that is looked at
void toggle_slow_motion(ViewerState& state);
void toggle_comparison(ViewerState& state, Comparison::Kind kind);

template <Buffer buffer>
void show_buffer(ViewerState& state) {
    set_buffer(state, buffer);
}

template <Buffer buffer>
bool shows_buffer(const ViewerState& state) {
    return std::all_of(state.panes.begin(), state.panes.end(),
                       [](const PaneState& pane) { return pane.settings.buffer == buffer; });
}

template <int count>
void set_panes(ViewerState& state) {
    state.set_pane_count(count);
}

template <int count>
bool has_panes(const ViewerState& state) {
    return state.panes.size() == count;
}

template <Comparison::Kind kind>
bool compares(const ViewerState& state) {
    return state.active().settings.comparison.kind == kind;
}

template <Comparison::Kind kind>
void toggle(ViewerState& state) {
    toggle_comparison(state, kind);
}

} // namespace tessera
