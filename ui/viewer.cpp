#include "ui/viewer.h"

#include "ui/actions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <imgui.h>

namespace tessera {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr float longest_step = 0.1f; // seconds that a held key moves in one frame at the most

/// Panes beside each other; from three on in two rows.
ScreenRect pane_rect(const ScreenRect& all, int pane, int panes) {
    const int rows = panes > 2 ? 2 : 1;
    const int columns = (panes + rows - 1) / rows;
    const glm::vec2 cell = all.size() / glm::vec2(columns, rows);
    const glm::vec2 min = all.min + cell * glm::vec2(pane % columns, pane / columns);
    return {glm::floor(min), glm::floor(min + cell)};
}

} // namespace

Viewer::Viewer(Session& session, ViewerOptions options)
    : session_(session), options_(std::move(options)), pane_views_(options_.panes.size()),
      sent_(options_.panes.size()) {
    for (const PaneSettings& settings : options_.panes)
        state_.panes.push_back({settings, nullptr, 0, glm::ivec2(0)});
    state_.active_pane = static_cast<int>(state_.panes.size()) - 1;
    state_.size = options_.size;
    state_.spp_limit = options_.spp_limit;
    state_.show_panel = options_.show_panel;
}

void Viewer::load(std::string name, SceneLoader loader) {
    load_start_ = Clock::now();
    load_.start(std::move(name), std::move(loader), options_.wake);
}

// --- taking in ---

void Viewer::take_scene() {
    std::optional<SceneLoadResult> result = load_.poll();
    if (!result)
        return;
    for (std::string& note : result->notes)
        state_.add_message(Message::Kind::note, std::move(note));
    if (!result->scene) {
        state_.add_message(Message::Kind::error, std::move(result->error));
        return;
    }
    state_.scene = std::move(result->scene);
    state_.scene_name = std::move(result->name);
    state_.camera.set_home(state_.scene->camera(), state_.scene->center(), state_.scene->radius());
    state_.view.fit();
    const int depth = std::clamp(options_.max_depth.value_or(state_.scene->max_depth()), 1, 64);
    for (PaneState& pane : state_.panes)
        pane.settings.render.max_depth = depth;
}

void Viewer::take_snapshots() {
    for (std::size_t i = 0; i < state_.panes.size(); ++i) {
        if (auto snapshot = session_.latest(static_cast<int>(i)))
            state_.panes[i].snapshot = std::move(snapshot);
    }
    for (std::string& message : session_.take_messages())
        state_.add_message(Message::Kind::error, std::move(message));
}

void Viewer::read_keyboard() {
    const ImGuiIO& io = ImGui::GetIO();
    run_shortcuts(keyboard_.take(), io.WantTextInput, state_);
    flying_ = !io.WantTextInput && fly_with_keys(keyboard_, std::min(io.DeltaTime, longest_step), state_);
}

// --- drawing ---

void Viewer::draw_frame() {
    take_scene();
    take_snapshots();
    controls_.begin_frame(ImGui::GetTime());
    read_keyboard();

    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float top = draw_menu_bar(controls_, state_);
    const float panel_width = std::floor(std::min(ImGui::GetFontSize() * 20, display.x * 0.5f));
    ScreenRect pictures{{0, top}, {display.x, std::max(display.y, top + 1)}};
    if (state_.show_panel) {
        pictures.max.x -= panel_width;
        draw_settings_panel({{pictures.max.x, top}, {display.x, pictures.max.y}}, controls_, state_);
    }
    draw_panes(pictures);
    draw_overlays(pictures);
    send_changes();
    log_changes();
}

void Viewer::draw_panes(const ScreenRect& where) {
    const int panes = static_cast<int>(state_.panes.size());
    for (int i = 0; i < panes; ++i)
        pane_views_[static_cast<std::size_t>(i)].draw(i, pane_rect(where, i, panes), shader_, controls_, state_);
}

void Viewer::draw_overlays(const ScreenRect& pictures) {
    if (state_.show_messages) {
        const float height = std::min(ImGui::GetFontSize() * 11, pictures.size().y);
        draw_message_panel({{pictures.min.x, pictures.max.y - height}, pictures.max}, controls_, state_);
    }
    if (state_.show_help) {
        const ImVec2 display = ImGui::GetIO().DisplaySize;
        draw_help({display.x, display.y}, controls_, state_);
    }
    if (load_.running()) {
        const double seconds = std::chrono::duration<double>(Clock::now() - load_start_).count();
        draw_loading(pictures, load_.name(), seconds);
    }
}

double Viewer::next_frame_in() const {
    if (flying_)
        return 0;
    if (load_.running() || controls_.tooltip_pending())
        return 0.1;
    return ImGui::GetIO().WantTextInput ? 0.2 : never; // a blinking cursor
}

// --- sending ---

bool Viewer::differs(const PaneState& pane, const Sent& sent) const {
    return sent.scene != state_.scene || !(sent.camera == state_.camera.camera()) ||
           sent.size != state_.request_size() || !(sent.render == pane.settings.render) ||
           sent.spp_limit != state_.spp_limit;
}

void Viewer::send_changes() {
    if (state_.paused != sent_paused_)
        session_.set_paused(state_.paused);
    sent_paused_ = state_.paused;
    for (std::size_t i = 0; state_.scene && i < state_.panes.size(); ++i) {
        PaneState& pane = state_.panes[i];
        Sent& sent = sent_[i];
        const int index = static_cast<int>(i);
        const bool first = !sent.scene;
        if (first || !(sent.reconstruction == pane.settings.reconstruction))
            session_.set_reconstruction(index, pane.settings.reconstruction);
        sent.reconstruction = pane.settings.reconstruction;
        if (!state_.restart && !differs(pane, sent))
            continue;
        sent = {state_.scene,         state_.camera.camera(),       state_.request_size(),
                pane.settings.render, pane.settings.reconstruction, state_.spp_limit};
        pane.generation =
            session_.submit(index, {sent.scene, sent.camera, sent.size, sent.render, sent.spp_limit});
    }
    state_.restart = false;
}

bool Viewer::settled(int spp) const {
    if (load_.running() || !state_.scene)
        return false;
    return std::all_of(state_.panes.begin(), state_.panes.end(), [&](const PaneState& pane) {
        const Snapshot* snapshot = pane.snapshot.get();
        if (snapshot == nullptr || snapshot->generation != pane.generation || snapshot->coarse ||
            snapshot->spp < spp)
            return false;
        const bool reconstructs = has_gradients(snapshot->settings.method);
        return !reconstructs || (snapshot->reconstruction && snapshot->reconstruction_spp == snapshot->spp);
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
