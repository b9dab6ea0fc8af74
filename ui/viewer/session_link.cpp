#include "ui/viewer/session_link.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace tessera {

namespace {
constexpr int few_samples = 8; // per pixel; a better size may discard fewer (not tuned)
} // namespace

void SessionLink::take(ViewerState& state) {
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        PaneState& pane = state.panes[i];
        if (auto snapshot = session_.latest(pane.slot))
            pane.snapshot = std::move(snapshot);
        pane.failed = session_.has_failed(pane.slot);
        pane.failure = session_.failure(pane.slot);
        pane.pass_progress = session_.pass_progress(pane.slot);
        pane.reconstructing = session_.reconstructing(pane.slot);
        report_invalid_samples(state, i);
    }
    for (std::string& message : session_.take_messages())
        state.add_message(Message::Kind::error, std::move(message));
}

/// Reports the invalid samples of each request once. Skips previews, because their pixels differ from the
/// render's.
void SessionLink::report_invalid_samples(ViewerState& state, std::size_t pane) {
    const Snapshot* snapshot = state.panes[pane].snapshot.get();
    std::uint64_t& reported = reported_invalid_[state.panes[pane].slot];
    const Sent& sent = sent_of(state.panes[pane]);
    if (snapshot == nullptr || snapshot->coarse() || snapshot->generation == reported ||
        snapshot->generation != sent.generation)
        return;
    if (snapshot->counters.first_invalid.list().empty())
        return;
    reported = snapshot->generation;
    state.add_invalid(std::string(paper_name(snapshot->settings.method)), snapshot->counters,
                      state.panes[pane].slot,
                      {sent.scene, snapshot->camera, sent.size, snapshot->settings, {}, snapshot->generation});
}

void SessionLink::send(ViewerState& state) {
    send_pace(state);
    latch_size(state);
    if (state.scene)
        send_panes(state);
    std::array<bool, most_panes> is_used{};
    for (const PaneState& pane : state.panes)
        is_used[pane.slot] = true;
    for (std::size_t slot = 0; slot < sent_.size(); ++slot) {
        if (!is_used[slot] && std::exchange(sent_[slot], {}).scene)
            session_.withdraw(static_cast<int>(slot));
    }
    if (std::exchange(state.wishes.give_up_reconstructions, false))
        give_up_reconstructions(state);
    state.wishes.restart = false;
    for (; state.wishes.steps > 0; --state.wishes.steps)
        session_.step();
}

/// Cancels the reconstructions that the viewer shows as under way.
void SessionLink::give_up_reconstructions(ViewerState& state) {
    for (const PaneState& pane : state.panes) {
        if (!state.reconstructs_long(pane))
            continue;
        session_.stop_reconstruction(pane.slot);
        state.add_message(Message::Kind::note, std::string(paper_name(pane.settings.render.method)) +
                                                   ": the reconstruction of pass " +
                                                   std::to_string(pane.reconstructing->spp) + " was cancelled.");
    }
}

void SessionLink::send_pace(const ViewerState& state) {
    if (state.rendering.paused != sent_paused_)
        session_.set_paused(state.rendering.paused);
    if (!(state.rendering.pace == sent_pace_))
        session_.set_pace(state.rendering.pace);
    sent_paused_ = state.rendering.paused;
    sent_pace_ = state.rendering.pace;
}

/// Whether the pane has to restart its render for a reason other than its size.
bool SessionLink::needs_restart(const ViewerState& state, const PaneState& pane) const {
    const Sent& sent = sent_of(pane);
    return state.wishes.restart || sent.scene != state.scene || !(sent.camera == state.camera.camera()) ||
           !(sent.render == pane.settings.render);
}

/// Updates the rendered size. A new size restarts every render, so a size that only fits better waits until no
/// pane would lose samples; until then the pictures are scaled. After a panel opens or closes, any render counts
/// as a loss, even a first pass under way. After a change of the window or of the number of panes, few_samples or
/// more count. A size that the user chooses applies at once.
void SessionLink::latch_size(ViewerState& state) {
    const Arrangement arrangement{state.layout.window_size, state.panes.size()};
    const bool only_panels_changed = arrangement == latched_arrangement_;
    const auto would_lose_samples = [&](const PaneState& pane) {
        if (needs_restart(state, pane))
            return false;
        const Snapshot* s = pane.snapshot.get();
        return only_panels_changed || (s && s->generation == sent_of(pane).generation && s->spp >= few_samples);
    };
    if (state.rendering.size == latched_choice_ &&
        std::any_of(state.panes.begin(), state.panes.end(), would_lose_samples))
        return;
    state.rendering.latched_size = state.fitting_size();
    latched_choice_ = state.rendering.size;
    latched_arrangement_ = arrangement;
}

/// Returns the pane whose render this pane shows. Panes with equal render settings share one render, which each
/// reconstructs itself. A pane that renders these settings already is preferred.
std::size_t SessionLink::rendering_pane(const ViewerState& state, std::size_t pane) const {
    const RenderSettings& wanted = state.panes[pane].settings.render;
    std::size_t first = pane;
    for (std::size_t i = state.panes.size(); i-- > 0;)
        if (state.panes[i].settings.render == wanted)
            first = i;
    for (std::size_t i = first; i < state.panes.size(); ++i) {
        const Sent& sent = sent_of(state.panes[i]);
        if (state.panes[i].settings.render == wanted && sent.scene && sent.followed < 0 && sent.render == wanted)
            return i;
    }
    return first;
}

/// Moves the pane to another slot. The pane in that slot gets this pane's slot; their charts are swapped.
void SessionLink::swap_slots(ViewerState& state, PaneState& pane, int slot) {
    const int before = pane.slot;
    for (PaneState& other : state.panes)
        if (other.slot == slot)
            other.slot = before;
    pane.slot = slot;
    std::swap(state.charts[before], state.charts[slot]);
}

void SessionLink::send_panes(ViewerState& state) {
    std::vector<std::size_t> renders(state.panes.size());
    for (std::size_t i = 0; i < state.panes.size(); ++i)
        renders[i] = rendering_pane(state, i);
    // If a pane that rendered for others has changed or is removed, one of the others takes over its slot with
    // the samples.
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        PaneState& pane = state.panes[i];
        const int followed = sent_of(pane).followed;
        if (renders[i] == i && followed >= 0 && sent_[followed].scene &&
            sent_[followed].render == pane.settings.render)
            swap_slots(state, pane, followed);
    }
    for (std::size_t i = 0; i < state.panes.size(); ++i)
        if (renders[i] == i)
            send_pane(state, state.panes[i]);
    for (std::size_t i = 0; i < state.panes.size(); ++i)
        if (renders[i] != i)
            let_follow(state.panes[i], state.panes[renders[i]]);
}

void SessionLink::let_follow(PaneState& pane, const PaneState& other) {
    Sent& sent = sent_of(pane);
    if (!sent.scene || !(sent.reconstruction == pane.settings.reconstruction))
        session_.set_reconstruction(pane.slot, pane.settings.reconstruction);
    if (sent.followed != other.slot || sent.generation != other.generation)
        session_.follow(pane.slot, other.slot);
    sent = sent_of(other);
    sent.reconstruction = pane.settings.reconstruction;
    sent.followed = other.slot;
    pane.generation = sent.generation;
    reported_invalid_[pane.slot] = sent.generation; // the rendering pane reports these
}

void SessionLink::send_pane(ViewerState& state, PaneState& pane) {
    Sent& sent = sent_of(pane);
    if (!sent.scene || !(sent.reconstruction == pane.settings.reconstruction))
        session_.set_reconstruction(pane.slot, pane.settings.reconstruction);
    sent.reconstruction = pane.settings.reconstruction;
    if (needs_restart(state, pane) || sent.size != state.request_size() || sent.followed >= 0) {
        sent.followed = -1;
        sent.scene = state.scene;
        sent.camera = state.camera.camera();
        sent.size = state.request_size();
        sent.render = pane.settings.render;
        sent.generation = session_.submit(pane.slot, {sent.scene, sent.camera, sent.size, sent.render});
    }
    pane.generation = sent.generation;
}

} // namespace tessera
