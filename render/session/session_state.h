#pragma once

#include "render/session/session.h"
#include "render/session/session_pane.h"

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tessera {

/// State that the threads of a session share. Guarded by `mutex`, except the condition variables and `on_publish`.
struct SessionState {
    mutable std::mutex mutex;
    std::condition_variable_any render_wake;
    std::condition_variable_any reconstruct_wake;
    std::function<void()> on_publish; // may be empty
    std::vector<std::unique_ptr<SessionPane>> panes;
    std::vector<std::string> messages;
    bool paused = false;
    Pace pace;
    std::uint64_t generation = 0; // of the newest request

    /// Returns the pane that renders a pane's picture: itself, or the one that it follows. Needs the lock.
    const SessionPane& rendering(int pane) const;

    // These take the lock.

    /// Calls on_publish. An exception becomes a message, so that it ends no worker.
    void tell();
    /// Adds a message, and calls tell().
    void report(std::string message);
    /// Returns the pane's reconstruction settings. Replaces an unavailable norm, with a message. The first call
    /// can be slow, because it searches for a library, so only workers may call it.
    ReconstructionSettings possible_reconstruction(SessionPane& pane);
};

} // namespace tessera
