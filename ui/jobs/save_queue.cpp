#include "ui/jobs/save_queue.h"

#include "render/run/thread_pool.h"

namespace tessera {

SaveQueue::~SaveQueue() {
    finish();
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
        {},
        [work = std::move(next.work)](std::stop_token) {
            work_in_background();
            return work();
        },
        std::move(next.on_done));
}

std::vector<SaveQueue::Outcome> SaveQueue::finish() {
    std::vector<Outcome> outcomes;
    for (; job_.running(); start_next())
        outcomes.push_back(*job_.wait());
    return outcomes;
}

std::optional<SaveQueue::Outcome> SaveQueue::take() {
    std::optional<Outcome> outcome = job_.take();
    start_next();
    return outcome;
}

} // namespace tessera
