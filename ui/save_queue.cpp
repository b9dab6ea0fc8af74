#include "ui/save_queue.h"

#include "render/session/thread_priority.h"

namespace tessera {

SaveQueue::~SaveQueue() {
    job_ = {}; // waits
    for (const Waiting& next : waiting_) {
        try {
            next.work();
        } catch (const std::exception&) { // nobody is left to be told
        }
    }
}

void SaveQueue::add(Work work, std::function<void()> on_done) {
    waiting_.push_back({std::move(work), std::move(on_done)});
    start_next();
}

void SaveQueue::start_next() {
    if (job_.running() || waiting_.empty())
        return;
    Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    job_.start(
        [work = std::move(next.work)](std::stop_token) {
            work_in_background();
            return work();
        },
        std::move(next.on_done));
}

std::optional<SaveQueue::Outcome> SaveQueue::poll() {
    std::optional<Outcome> outcome = job_.poll();
    start_next();
    return outcome;
}

} // namespace tessera
