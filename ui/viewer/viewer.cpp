#include "ui/viewer/viewer.h"

#include "render/io/plain_images.h"
#include "render/scene/scene.h"
#include "ui/charts/charts.h"
#include "ui/gl/gl.h"
#include "ui/inside/inside.h"
#include "ui/panels/panels.h"
#include "ui/state/actions.h"
#include "ui/state/file_names.h"
#include "ui/state/words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <imgui.h>

namespace tessera {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr float most_panel_share = 0.5f; // of the window's width
constexpr int frames_until_still = 3;    // Dear ImGui fits tables a frame or two later
constexpr float longest_step = 0.1f;     // seconds that a held key moves in one frame at the most

/// The place of a pane: from three on, they lie in two rows.
ScreenRect pane_rect(const ScreenRect& all, int pane, int panes, glm::vec2 picture) {
    // Two lie as their pictures are larger, beside each other or one above the other.
    const float strips = 3.6f * ImGui::GetFontSize(); // of a pane, above and below its picture
    const auto scale = [&](int columns, int rows) {
        const glm::vec2 room = all.size() / glm::vec2(columns, rows) - glm::vec2(0, strips);
        return std::min(room.x / picture.x, room.y / picture.y);
    };
    const int rows = panes > 2 || (panes == 2 && scale(1, 2) > scale(2, 1)) ? 2 : 1;
    const int columns = (panes + rows - 1) / rows;
    const glm::vec2 cell = all.size() / glm::vec2(columns, rows);
    const glm::vec2 min = all.min + cell * glm::vec2(pane % columns, pane / columns);
    return {glm::floor(min), glm::floor(min + cell)};
}

} // namespace

Viewer::Viewer(Session& session, ViewerOptions options) : link_(session), options_(std::move(options)) {
    for (const PaneSettings& settings : options_.panes) {
        PaneState& pane = state_.panes.emplace_back();
        pane.settings = settings;
        pane.slot = static_cast<int>(state_.panes.size()) - 1;
    }
    state_.active_pane = static_cast<int>(state_.panes.size()) - 1;
    asked_panes_ = options_.panes_as_remembered ? 0 : static_cast<int>(state_.panes.size());
    state_.size = options_.size;
    state_.pace.spp_limit = options_.spp_limit;
    state_.wishes.open_reference = options_.reference.string();
    state_.wishes.follow_jobs = options_.jobs.string();
    state_.layout.show_gallery = options_.begins_with_gallery;
    take_preferences();
    if (options_.sample) {
        options_.sample->slot = state_.active().slot;
        state_.inspect(*options_.sample);
    }
}

Viewer::~Viewer() {
    for (const SaveQueue::Outcome& outcome : save_queue_.finish())
        if (!outcome.result) // there is no list of messages any more
            std::fprintf(stderr, "%s\n", outcome.error.c_str());
    remember(); // after what the queue had to write of it
}

// --- a new scene ---

void Viewer::take_scene() {
    std::optional<SceneLoadResult> result = load_.take();
    state_.loading = load_.running() ? to_string(load_.progress()) : "";
    if (!result)
        return;
    using Origin = Message::Origin;
    state_.drop_messages(Origin::failed_load);
    if (result->scene)
        state_.drop_messages(Origin::scene);
    for (SceneNote& note : result->notes)
        state_.add_message(note.is_error ? Message::Kind::error : Message::Kind::note, std::move(note.text),
                           result->scene ? Origin::scene : Origin::failed_load);
    if (result->scene) {
        show_scene(std::move(result->scene), result->origin);
        return;
    }
    if (!state_.scene)
        state_.scene_problem = {result->error, true};
    drop_settings_of(result->origin);
    state_.add_message(Message::Kind::error, std::move(result->error), Origin::failed_load);
}

void Viewer::show_scene(std::shared_ptr<const Scene> scene, const SceneOrigin& origin) {
    const std::shared_ptr<const Scene> before = std::exchange(state_.scene, std::move(scene));
    const bool again = before && is_same_scene(shown_, origin);
    shown_ = origin;
    state_.scene_problem = {};
    state_.scene_name = origin.name;
    state_.scene_source = origin.source;
    state_.space = {};
    ++state_.scenes_shown;
    std::error_code gone; // the current folder: then nobody knows where the file was
    const std::filesystem::path file = std::filesystem::absolute(origin.source.file, gone);
    if (!origin.source.file.empty() && !gone)
        opened_scenes_.push_back(file);
    remember_later();
    if (!again || !(before->camera() == state_.scene->camera())) {
        state_.camera.set_home(state_.scene->camera(), state_.scene->center(), state_.scene->radius());
        state_.set_view({});
    }
    if (!again) {
        state_.history = {};
        state_.bookmarks.clear();
        state_.bookmark = -1;
    }
    const auto depth_of = [&](const Scene& s) {
        return std::clamp(options_.max_depth.value_or(s.max_depth()), 1, most_edges);
    };
    const auto set_depth = [&](PaneSettings& pane) {
        int& depth = pane.render.max_depth;
        if (!again || depth == depth_of(*before)) // not one that the user has set
            depth = depth_of(*state_.scene);
    };
    std::ranges::for_each(state_.panes, set_depth, &PaneState::settings);
    std::ranges::for_each(state_.spare_panes, set_depth);
}

// --- drawing ---

void Viewer::draw_frame() {
    frames_due_ =
        std::exchange(state_.wishes.redraw, false) ? frames_until_still - 1 : std::max(frames_due_ - 1, 0);
    take_scene();
    link_.take(state_);
    controls_.begin_frame(ImGui::GetTime());
    read_keyboard();

    const ImVec2 display = ImGui::GetIO().DisplaySize;
    state_.layout.window_size = {display.x, display.y};
    if (!state_.layout.window.maximised)
        state_.layout.window.size = state_.layout.window_size;
    const float top = draw_menu_bar(controls_, state_);
    const float panel_width =
        std::floor(std::min(ImGui::GetFontSize() * state_.layout.panel_width, display.x * most_panel_share));
    ScreenRect pictures{{0, top}, {display.x, std::max(display.y, top + 1)}};
    if (state_.layout.show_panel || state_.layout.show_statistics || state_.layout.show_charts) {
        pictures.max.x -= panel_width;
        draw_side({{pictures.max.x, top}, {display.x, pictures.max.y}});
        draw_panel_edge(pictures, controls_, state_);
    }
    ScreenRect bottom = pictures;
    const BottomHeights heights = bottom_heights(pictures.size().y);
    pictures.max.y = bottom.min.y = pictures.max.y - heights.messages - heights.inside;
    draw_panes(pictures);
    draw_bottom(bottom, heights);
    draw_overlays(pictures);
    if (std::exchange(state_.wishes.auto_exposure, false))
        expose();
    fulfil_wishes();
    keep_thumbnail();
    note_history();
    link_.send(state_);
    companion_jobs_.update(state_, options_.wake);
    inspection_job_.update(state_, options_.wake);
    slow_motion_job_.update(state_, std::min(ImGui::GetIO().DeltaTime, longest_step), options_.wake);
    surroundings_job_.update(state_, options_.wake);
    reference_job_.update(state_, options_.threads, options_.wake);
    chart_job_.update(state_, options_.wake);
    if (!state_.histograms_due) // their end brings a frame
        if (const auto file = state_.wishes.saves.take(SaveKind::charts))
            save_charts(*file);
    log_changes();
}

/// Draws settings above, statistics and charts below: all scroll, and share the room evenly.
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

void Viewer::draw_panes(const ScreenRect& where) {
    const int panes = static_cast<int>(state_.panes.size());
    bool wants_reference = false;
    for (std::size_t i = 0; i < state_.panes.size(); ++i) {
        images_[i].take(state_.panes[i].snapshot.get(), state_.panes[i].settings.buffer, state_.companions);
        wants_reference |= state_.compared_with(static_cast<int>(i)) == the_reference;
    }
    for (std::size_t i = state_.panes.size(); i < most_panes; ++i)
        images_[i].take(nullptr, Buffer::reconstruction, {});
    images_[the_reference].take(nullptr, Buffer::reference, wants_reference ? state_.companions : Companions{});
    if (state_.layout.cursor &&
        (state_.layout.cursor->pane >= panes || !state_.is_on_show(state_.layout.cursor->pane)))
        state_.layout.cursor.reset();
    PaneTools tools{shader_, images_, controls_, state_};
    const int alone = state_.layout.alone ? state_.active_pane : -1;
    const glm::vec2 picture(state_.scene ? state_.scene->size() : glm::ivec2(16, 9));
    const auto each = [&](auto&& act) {
        for (int i = 0; i < panes; ++i) {
            if (alone < 0 || alone == i)
                act(pane_views_[static_cast<std::size_t>(i)], i);
        }
    };
    each([&](PaneView& view, int i) {
        view.take_input(i, alone < 0 ? pane_rect(where, i, panes, picture) : where, tools);
    });
    each([&](PaneView& view, int i) { view.draw(i, tools); });
}

/// The heights of the panels below the pictures, together at most half the room that there is; 0: there is none.
Viewer::BottomHeights Viewer::bottom_heights(float room) const {
    const float font = ImGui::GetFontSize(), least = font * 11;
    const float large = std::max(least, std::min(font * 17, room * 0.36f));
    const bool looks_inside = state_.slow_motion.active || state_.inspector.active;
    const float messages = state_.layout.show_messages ? looks_inside ? font * 7 : least : 0;
    const float inside = looks_inside ? large : 0;
    const float share = std::min(1.0f, room / 2 / std::max(messages + inside, 1.0f));
    return {std::floor(messages * share), std::floor(inside * share)};
}

/// Messages lie above what looks inside: neither hides the other.
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

void Viewer::draw_overlays(const ScreenRect& pictures) {
    if (state_.layout.large_charts)
        draw_large_charts(pictures, controls_, state_);
    const glm::vec2 screen(state_.layout.window_size);
    if (state_.layout.show_jobs)
        jobs_panel_.draw(pictures, controls_, state_, follower_.view());
    if (state_.reference_making.show)
        draw_reference_dialog(screen, controls_, state_);
    if (state_.layout.sample_form.show)
        draw_sample_dialog(screen, controls_, state_);
    if (state_.layout.show_help)
        help_.draw(screen, controls_, state_);
    if (load_.running())
        draw_loading(pictures, controls_, state_, load_.origin().name, load_.progress(), load_.seconds());
    else if (!state_.scene && !state_.scene_problem.text.empty())
        draw_no_scene(pictures, controls_, state_);
    if (state_.layout.show_gallery)
        gallery_.draw(pictures, controls_, state_,
                      {options_.gallery, options_.preferences, thumbnails_stored_, options_.wake});
    palette_.draw(screen, controls_, state_);
    draw_toast(pictures, controls_, state_);
    file_dialog_.draw(screen, controls_, state_); // last: it is modal, and windows may not appear after such
}

/// The exposure and the range of false colours that show what the active pane shows.
void Viewer::expose() {
    const auto clamped = [](float stops) {
        return std::clamp(stops, ranges::exposure.low(), ranges::exposure.high());
    };
    if (shows_slow_motion(state_.active_pane, state_)) { // which covers the picture
        if (const auto exposure = exposure_of(slow_motion_luminances(state_.slow_motion)))
            state_.tone.exposure = clamped(*exposure);
        return;
    }
    const Showing showing = sides_of(state_, state_.active_pane).left;
    const PaneImage& image = images_[static_cast<std::size_t>(showing.pane)];
    if (image.empty())
        return;
    const Buffer buffer = buffer_of(showing.pane, state_);
    const ColourMap map = colour_map(showing, state_);
    if (map == ColourMap::false_colour)
        state_.ranges[buffer] = automatic_range(buffer, image.pixels(), state_.companions);
    else if (const auto exposure = exposure_of(showing, images_); exposure && map == ColourMap::signed_difference)
        state_.tone.difference_exposure = clamped(*exposure) - state_.tone.exposure; // pictures stay as they are
    else if (exposure)
        state_.tone.exposure = clamped(*exposure);
}

/// A drag, a held key or a value that is being typed is one step.
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
        return 0.2; // it goes by itself
    if (load_.running() || controls_.tooltip_pending() || reconstructs || renders_long)
        return 0.1;
    return ImGui::GetIO().WantTextInput ? 0.2 : never; // a blinking cursor
}

bool Viewer::settled(int spp) const {
    if (load_.running() || !state_.scene)
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

bool PictureSaver::after_frame(Viewer& viewer, glm::ivec2 pixels) {
    ViewerState& state = viewer.state();
    age_ = state.wishes.saves.has(SaveKind::window) ? age_ + 1 : 0;
    if (age_ == frames_until_still) {
        const std::string chosen = *state.wishes.saves.take(SaveKind::window);
        viewer.save([file = viewer.file_to_save(chosen, ".png"), screen = read_screen(pixels)] {
            write_png(file, screen.size, screen.rgb);
            return file.string();
        });
    }
    return age_ > 0;
}

} // namespace tessera
