#pragma once

#include "render/session/session_state.h"

#include <cstddef>
#include <memory>
#include <stop_token>
#include <thread>

namespace tessera {

/// Reconstructs the newest snapshots of a session's panes in turn, on its own thread.
class ReconstructionWorker {
public:
    explicit ReconstructionWorker(SessionState& shared)
        : shared_(shared), thread_([this](std::stop_token stop) { loop(stop); }) {}

    /// Ends the loop after the current work. The destructor waits for it.
    void request_stop() { thread_.request_stop(); }

private:
    /// A snapshot to reconstruct.
    struct Task {
        std::shared_ptr<const Snapshot> snapshot; // null: none
        ReconstructionSettings settings;
        bool cold = false; // no warm start
        std::stop_token stop;
    };
    SessionPane* next_pane();
    Task begin(SessionPane& pane);
    void reconstruct(SessionPane& pane, const Task& task);
    void loop(std::stop_token stop);

    SessionState& shared_;
    std::size_t turn_ = 0; // index of the first pane that next_pane() considers
    std::jthread thread_;  // last member: ends first
};

} // namespace tessera
