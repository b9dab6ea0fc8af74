#include "ui/jobs/followed_folder.h"

#include "render/io/available_memory.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <stop_token>
#include <utility>

namespace tessera {

namespace {

using Clock = std::chrono::steady_clock;

/// Pauses limit reads to a twentieth of the time, because the folder may be on a server that many workers use.
constexpr auto min_pause = std::chrono::milliseconds(500);
constexpr int pause_factor = 20; // of the time that the last read took

} // namespace

std::size_t FollowedFolder::count(FollowedJob::State state) const {
    return static_cast<std::size_t>(
        std::ranges::count(jobs, state, [](const FollowedJob& job) { return job.state; }));
}

void FolderFollower::follow(const std::filesystem::path& folder, FolderReader reader, std::function<void()> wake) {
    stop();
    current_ = std::make_unique<Following>();
    current_->view = {folder};
    current_->thread = std::jthread([following = current_.get(), reader = std::move(reader),
                                     wake = std::move(wake)](const std::stop_token& stop) {
        run(*following, stop, reader, wake);
        following->has_ended = true;
    });
}

void FolderFollower::stop() {
    std::erase_if(stopped_, [](const auto& following) { return following->has_ended.load(); });
    if (!current_)
        return;
    current_->thread.request_stop();
    stopped_.push_back(std::move(current_));
}

FolderFollower::View FolderFollower::view() const {
    if (!current_)
        return {};
    const std::scoped_lock lock(current_->mutex);
    return current_->view;
}

void FolderFollower::run(Following& following, const std::stop_token& stop, const FolderReader& reader,
                         const std::function<void()>& wake) {
    std::mutex mutex;
    std::unique_lock waiting(mutex);
    std::condition_variable_any never;
    for (Clock::duration pause{}; !stop.stop_requested();
         never.wait_for(waiting, stop, pause, [] { return false; })) {
        const Clock::time_point begin = Clock::now();
        std::shared_ptr<const FollowedFolder> seen;
        std::string error;
        try {
            seen = reader();
        } catch (const std::exception& e) {
            error = message_of(e);
        }
        if (stop.stop_requested())
            return;
        pause = std::max<Clock::duration>(min_pause, pause_factor * (Clock::now() - begin));
        {
            const std::scoped_lock lock(following.mutex);
            if (!seen && error == following.view.error)
                continue;
            if (seen)
                following.view.seen = std::move(seen);
            following.view.error = error;
        }
        if (wake)
            wake();
    }
}

} // namespace tessera
