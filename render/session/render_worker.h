#pragma once

#include "render/run/thread_pool.h"
#include "render/session/session_state.h"

#include <cstdint>
#include <memory>
#include <stop_token>
#include <thread>

namespace tessera {

/// Renders passes and previews of a session's panes in turn, on its own thread and pool, and publishes snapshots.
class RenderWorker {
public:
    /// @param threads  as in ThreadPool
    RenderWorker(SessionState& shared, int threads);

    /// Ends the loop after the current work. The destructor waits for it.
    void request_stop() { thread_.request_stop(); }

private:
    void loop(std::stop_token stop);
    SessionPane* next_pane();
    SessionPane* unpublished_pane();
    std::unique_ptr<Render> withdrawn_render();
    void step(SessionPane& pane, std::stop_token worker_stop);
    void render_step(SessionPane& pane, const RenderRequest& request, std::uint64_t generation,
                     std::stop_token stop, std::stop_token worker_stop);
    void preview(SessionPane& pane, const RenderRequest& request, std::uint64_t generation, std::stop_token stop);
    double preview_budget() const;
    void give_up(SessionPane& pane, std::uint64_t generation, const std::string& why);
    void count_step(SessionPane& pane, std::uint64_t generation);
    void publish(SessionPane& pane, const std::shared_ptr<Snapshot>& snapshot);
    void publish_passes(SessionPane& pane);
    void publish_to_followers(const SessionPane& pane);

    SessionState& shared_;
    std::uint64_t turn_ = 0;
    ThreadPool pool_;
    std::jthread thread_; // last member: ends before the pool
};

} // namespace tessera
