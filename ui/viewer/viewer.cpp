#include "ui/viewer/viewer.h"

#include "ui/charts/charts.h"
#include "ui/inside/inside.h"
#include "ui/panels/panels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr float max_panel_fraction = 0.5f; // of the window's width
constexpr int frames_to_settle = 3;        // Dear ImGui fits tables with a delay of one or two frames
constexpr float longest_step = 0.1f;       // maximum advance of the slow motion per frame, seconds

} // namespace

Viewer::Viewer(Session& session, ViewerOptions options)
    : options_(std::move(options)), link_(session), scenes_(options_.max_depth, options_.wake),
      saver_(options_.write_exr, options_.wake), memory_(options_.preferences) {
    for (const PaneSettings& settings : options_.panes) {
        PaneState& pane = state_.panes.emplace_back();
        pane.settings = settings;
        pane.slot = static_cast<int>(state_.panes.size()) - 1;
    }
    state_.active_pane = static_cast<int>(state_.panes.size()) - 1;
    state_.rendering.size = options_.size;
    state_.rendering.pace.spp_limit = options_.spp_limit;
    state_.wishes.open_reference = options_.reference.string();
    state_.wishes.follow_jobs = options_.jobs.string();
    state_.layout.show_gallery = options_.begins_with_gallery;
    memory_.restore(state_, options_.uses_stored_pane_count ? 0 : static_cast<int>(state_.panes.size()));
    if (options_.sample) {
        options_.sample->slot = state_.active().slot;
        state_.inspect(*options_.sample);
    }
}

Viewer::~Viewer() {
    saver_.finish();
    remember(); // last, because the saver stores preferences as well
}

void Viewer::draw_frame() {
    frames_due_ = std::exchange(state_.wishes.redraw, false) ? frames_to_settle - 1 : std::max(frames_due_ - 1, 0);
    if (scenes_.take(state_))
        memory_.add_scene(scenes_.shown().source.file, state_, saver_);
    link_.take(state_);
    controls_.begin_frame(ImGui::GetTime());
    read_keyboard();
    draw_panels();
    fulfil_wishes();
    memory_.keep_thumbnail(state_, scenes_.shown().source, saver_);
    note_history();
    link_.send(state_);
    work_.update(state_, std::min(ImGui::GetIO().DeltaTime, longest_step), options_.threads, options_.wake);
    saver_.fulfil_charts(state_); // after work_, which sets charts.histograms_due
    log_changes();
}

void Viewer::draw_panels() {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    state_.layout.window_size = {display.x, display.y};
    if (!state_.layout.window.maximised)
        state_.layout.window.size = state_.layout.window_size;
    const float top = draw_menu_bar(controls_, state_);
    const float panel_width =
        std::floor(std::min(ImGui::GetFontSize() * state_.layout.panel_width, display.x * max_panel_fraction));
    ScreenRect pictures{{0, top}, {display.x, std::max(display.y, top + 1)}};
    if (state_.layout.show_panel || state_.layout.show_statistics || state_.layout.show_charts) {
        pictures.max.x -= panel_width;
        draw_side({{pictures.max.x, top}, {display.x, pictures.max.y}});
        draw_panel_edge(pictures, controls_, state_);
    }
    ScreenRect bottom = pictures;
    const BottomHeights heights = bottom_heights(pictures.size().y);
    pictures.max.y = bottom.min.y = pictures.max.y - heights.messages - heights.inside;
    pictures_.draw(pictures, controls_, state_);
    draw_bottom(bottom, heights);
    overlays_.draw(pictures, controls_, state_, options_, scenes_.under_way(), memory_.thumbnails_stored());
}

/// Draws settings, statistics and charts below each other, with equal heights.
void Viewer::draw_side(const ScreenRect& where) {
    const int panels = state_.layout.show_panel + state_.layout.show_statistics + state_.layout.show_charts;
    int drawn = 0;
    const auto next = [&] {
        const auto end = [&](int n) {
            return std::floor(
                glm::mix(where.min.y, where.max.y, static_cast<float>(n) / static_cast<float>(panels)));
        };
        const ScreenRect rect{{where.min.x, end(drawn)}, {where.max.x, end(drawn + 1)}};
        ++drawn;
        return rect;
    };
    if (state_.layout.show_panel)
        draw_settings_panel(next(), controls_, state_);
    if (state_.layout.show_statistics)
        draw_statistics_panel(next(), controls_, state_);
    if (state_.layout.show_charts)
        draw_charts_panel(next(), controls_, state_);
}

/// Returns heights that together are at most half of `room`.
Viewer::BottomHeights Viewer::bottom_heights(float room) const {
    const float font = ImGui::GetFontSize(), least = font * 11;
    const float large = std::max(least, std::min(font * 17, room * 0.36f));
    const bool shows_inside = state_.slow_motion.active || state_.inspector.active;
    const float messages = state_.layout.show_messages ? shows_inside ? font * 7 : least : 0;
    const float inside = shows_inside ? large : 0;
    const float scale = std::min(1.0f, room / 2 / std::max(messages + inside, 1.0f));
    return {std::floor(messages * scale), std::floor(inside * scale)};
}

/// Draws the messages, and below them the path inspector or the slow motion.
void Viewer::draw_bottom(const ScreenRect& where, const BottomHeights& heights) {
    const float middle = where.min.y + heights.messages;
    const ScreenRect inside{{where.min.x, middle}, where.max};
    if (heights.messages > 0)
        draw_message_panel({where.min, {where.max.x, middle}}, controls_, state_);
    if (heights.inside > 0 && state_.slow_motion.active)
        draw_slow_motion_panel(inside, controls_, state_);
    else if (heights.inside > 0)
        draw_inspector_panel(inside, controls_, state_);
}

/// Updates the undo history. A drag, a held key or a typed text becomes one step when it ends.
void Viewer::note_history() {
    if (state_.scene)
        state_.history.note(state_, flying_ || ImGui::IsAnyMouseDown() || ImGui::GetIO().WantTextInput);
}

double Viewer::next_frame_in() const {
    if (flying_ || state_.slow_motion.is_playing() || !all_drawn())
        return 0;
    const bool reconstructs =
        std::any_of(state_.panes.begin(), state_.panes.end(), [](const PaneState& p) { return p.reconstructing; });
    const bool renders_long = std::any_of(state_.panes.begin(), state_.panes.end(),
                                          [](const PaneState& p) { return is_in_long_first_pass(p); });
    if (!state_.layout.toast.text.empty())
        return 0.2; // the toast disappears after a time
    if (loading() || controls_.tooltip_pending() || reconstructs || renders_long)
        return 0.1;
    return ImGui::GetIO().WantTextInput ? 0.2 : never; // a blinking cursor
}

bool Viewer::settled(int spp) const {
    if (loading() || !state_.scene)
        return false;
    return std::all_of(state_.panes.begin(), state_.panes.end(), [&](const PaneState& pane) {
        const Snapshot* snapshot = pane.snapshot.get();
        if (snapshot == nullptr || snapshot->generation != pane.generation || snapshot->coarse() ||
            snapshot->spp < spp)
            return false;
        return snapshot->reconstruction && snapshot->reconstruction_spp == snapshot->spp;
    });
}

void Viewer::log_changes() {
    if (!options_.log)
        return;
    change_log_.write_state(state_, options_.log);
    if (options_.log_controls)
        change_log_.write_controls(controls_, options_.log);
}

} // namespace tessera
