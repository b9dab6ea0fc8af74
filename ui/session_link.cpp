#include "ui/session_link.h"

#include <utility>

namespace tessera {

void SessionLink::take(ViewerState& state) {
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        if (auto snapshot = session_.latest(static_cast<int>(i)))
            state.panes[i].snapshot = std::move(snapshot);
        report_refused(state, i);
    }
    for (std::string& message : session_.take_messages())
        state.add_message(Message::Kind::error, std::move(message));
}

/// Once for every request; not of a first look, whose pixels are others.
void SessionLink::report_refused(ViewerState& state, std::size_t pane) {
    const Snapshot* snapshot = state.panes[pane].snapshot.get();
    if (snapshot == nullptr || snapshot->coarse || snapshot->generation == refused_told_[pane])
        return;
    const std::string text = refused_text(snapshot->counters, snapshot->settings.seed);
    if (text.empty())
        return;
    refused_told_[pane] = snapshot->generation;
    state.add_message(Message::Kind::note, std::string(paper_name(snapshot->settings.method)) + ": " + text,
                      Message::Origin::scene);
    const RefusedSample& first = *snapshot->counters.first_refused;
    state.messages.back().sample = SampleChoice{static_cast<int>(pane), {first.x, first.y}, first.pass};
}

void SessionLink::send(ViewerState& state) {
    send_running(state);
    for (std::size_t i = 0; state.scene && i < state.panes.size(); ++i)
        send_pane(state, i);
    for (std::size_t i = state.panes.size(); i < sent_.size(); ++i) {
        if (std::exchange(sent_[i], {}).scene)
            session_.withdraw(static_cast<int>(i));
    }
    state.restart = false;
    for (; state.steps > 0; --state.steps)
        session_.step();
}

void SessionLink::send_running(const ViewerState& state) {
    if (state.paused != sent_paused_)
        session_.set_paused(state.paused);
    if (!(state.pace == sent_pace_))
        session_.set_pace(state.pace);
    sent_paused_ = state.paused;
    sent_pace_ = state.pace;
}

bool SessionLink::differs(const ViewerState& state, const PaneState& pane, const Sent& sent) {
    return sent.scene != state.scene || !(sent.camera == state.camera.camera()) ||
           sent.size != state.request_size() || !(sent.render == pane.settings.render);
}

void SessionLink::send_pane(ViewerState& state, std::size_t index) {
    PaneState& pane = state.panes[index];
    Sent& sent = sent_[index];
    const int session_pane = static_cast<int>(index);
    if (!sent.scene || !(sent.reconstruction == pane.settings.reconstruction))
        session_.set_reconstruction(session_pane, pane.settings.reconstruction);
    sent.reconstruction = pane.settings.reconstruction;
    if (!state.restart && !differs(state, pane, sent))
        return;
    sent = {state.scene, state.camera.camera(), state.request_size(), pane.settings.render,
            pane.settings.reconstruction};
    pane.generation = session_.submit(session_pane, {sent.scene, sent.camera, sent.size, sent.render});
}

} // namespace tessera
