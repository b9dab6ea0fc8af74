#pragma once

#include "render/session/session.h"
#include "ui/state/viewer_state.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <glm/vec2.hpp>

namespace tessera {

/// Connects the viewer's state with the render session: sends changes of the state as requests, and puts new
/// snapshots and messages into the state.
class SessionLink {
public:
    /// @param session  must have most_panes panes and outlive the link
    explicit SessionLink(Session& session) : session_(session) {}

    /// Puts new snapshots and messages into the state.
    void take(ViewerState& state);
    /// Sends the changes of the state since the last call. Fulfils the wishes to restart, to step and to end
    /// reconstructions.
    void send(ViewerState& state);

private:
    /// The last request of a slot.
    struct Sent {
        std::shared_ptr<const Scene> scene; // null: nothing was requested
        Camera camera;
        glm::ivec2 size{0};
        RenderSettings render;
        ReconstructionSettings reconstruction;
        std::uint64_t generation = 0;
        int followed = -1; // slot whose passes this one shows; -1: it renders its own
    };
    /// Window size and number of panes. With the open panels they determine the size of the pictures.
    struct Arrangement {
        glm::ivec2 window{0};
        std::size_t panes = 0;
        bool operator==(const Arrangement&) const = default;
    };
    Sent& sent_of(const PaneState& pane) { return sent_[pane.slot]; }
    const Sent& sent_of(const PaneState& pane) const { return sent_[pane.slot]; }
    bool needs_restart(const ViewerState& state, const PaneState& pane) const;
    void latch_size(ViewerState& state);
    std::size_t rendering_pane(const ViewerState& state, std::size_t pane) const;
    static void swap_slots(ViewerState& state, PaneState& pane, int slot);
    void send_panes(ViewerState& state);
    void send_pane(ViewerState& state, PaneState& pane);
    void let_follow(PaneState& pane, const PaneState& other);
    void send_pace(const ViewerState& state);
    void give_up_reconstructions(ViewerState& state);
    void report_invalid_samples(ViewerState& state, std::size_t pane);

    Session& session_;
    std::array<Sent, most_panes> sent_;                        // index: slot
    std::array<std::uint64_t, most_panes> reported_invalid_{}; // by slot: generation with reported invalid samples
    SizeChoice latched_choice_;                                // of the latched size
    Arrangement latched_arrangement_;                          // of the latched size
    bool sent_paused_ = false;
    Pace sent_pace_;
};

} // namespace tessera
