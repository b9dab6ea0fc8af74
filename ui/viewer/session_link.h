#pragma once

#include "ui/state/viewer_state.h"

#include <array>
#include <memory>

namespace tessera {

/// The viewer's dealings with the session: compares the state with what was last asked, sends what differs, and
/// takes in what has come.
class SessionLink {
public:
    /// `session` of most_panes panes.
    explicit SessionLink(Session& session) : session_(session) {}

    /// Takes in snapshots and messages.
    void take(ViewerState& state);
    /// Sends requests in the frame in which the state changed. Fulfils the wishes to restart and to step.
    void send(ViewerState& state);

private:
    /// What a slot was last asked for.
    struct Sent {
        std::shared_ptr<const Scene> scene; // null: nothing
        Camera camera;
        glm::ivec2 size{0};
        RenderSettings render;
        ReconstructionSettings reconstruction;
        std::uint64_t generation = 0;
    };
    Sent& sent_of(const PaneState& pane) { return sent_[static_cast<std::size_t>(pane.slot)]; }
    const Sent& sent_of(const PaneState& pane) const { return sent_[static_cast<std::size_t>(pane.slot)]; }
    bool starts_anew(const ViewerState& state, const PaneState& pane) const;
    void latch_size(ViewerState& state);
    void send_pane(ViewerState& state, PaneState& pane);
    void send_running(const ViewerState& state);
    void give_up_reconstructions(ViewerState& state);
    void report_refused(ViewerState& state, std::size_t pane);

    Session& session_;
    std::array<Sent, most_panes> sent_;                    // by slot, as the next
    std::array<std::uint64_t, most_panes> refused_told_{}; // the generation whose refused samples have a message
    SizeChoice latched_choice_;
    bool sent_paused_ = false;
    Pace sent_pace_;
};

} // namespace tessera
