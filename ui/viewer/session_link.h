#pragma once

#include "render/session/session.h"
#include "ui/state/viewer_state.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <glm/vec2.hpp>

namespace tessera {

/// Connects the state with the session: compares the state with the last requests, sends the differences, and puts
/// new snapshots and messages into the state.
class SessionLink {
public:
    /// `session` of most_panes panes.
    explicit SessionLink(Session& session) : session_(session) {}

    /// Puts new snapshots and messages into the state.
    void take(ViewerState& state);
    /// Sends requests in the frame in which the state changes. Fulfils the wishes to restart and to step.
    void send(ViewerState& state);

private:
    /// The last request of a slot.
    struct Sent {
        std::shared_ptr<const Scene> scene; // null: nothing
        Camera camera;
        glm::ivec2 size{0};
        RenderSettings render;
        ReconstructionSettings reconstruction;
        std::uint64_t generation = 0;
        int followed = -1; // slot whose passes it shows; -1: it renders its own
    };
    /// Window and number of panes, which determine the size of the pictures together with the panels.
    struct Arrangement {
        glm::ivec2 window{0};
        std::size_t panes = 0;
        bool operator==(const Arrangement&) const = default;
    };
    Sent& sent_of(const PaneState& pane) { return sent_[pane.slot]; }
    const Sent& sent_of(const PaneState& pane) const { return sent_[pane.slot]; }
    bool starts_anew(const ViewerState& state, const PaneState& pane) const;
    void latch_size(ViewerState& state);
    std::size_t renders_for(const ViewerState& state, std::size_t pane) const;
    static void give_slot(ViewerState& state, PaneState& pane, int slot);
    void send_panes(ViewerState& state);
    void send_pane(ViewerState& state, PaneState& pane);
    void let_follow(PaneState& pane, const PaneState& other);
    void send_running(const ViewerState& state);
    void give_up_reconstructions(ViewerState& state);
    void report_refused(ViewerState& state, std::size_t pane);

    Session& session_;
    std::array<Sent, most_panes> sent_; // by slot
    std::array<std::uint64_t, most_panes>
        refused_told_{};              // by slot: generation whose invalid samples are reported
    SizeChoice latched_choice_;       // of the size that is rendered
    Arrangement latched_arrangement_; // of the size that is rendered
    bool sent_paused_ = false;
    Pace sent_pace_;
};

} // namespace tessera
