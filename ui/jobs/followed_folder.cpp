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

/// The folder may be on a server that many workers ask: looks take a twentieth of the time at the most.
constexpr auto least_pause = std::chrono::milliseconds(500);
constexpr int pauses_a_look = 20;

} // namespace

std::size_t FollowedFolder::count(FollowedJob::State state) const {
    return static_cast<std::size_t>(
        std::ranges::count(jobs, state, [](const FollowedJob& job) { return job.state; }));
}

void FolderFollower::follow(const std::filesystem::path& folder, FolderReader reader, std::function<void()> wake) {
    stop();
    now_ = std::make_unique<Following>();
    now_->view = {folder};
    now_->thread = std::jthread(
        [following = now_.get(), reader = std::move(reader), wake = std::move(wake)](const std::stop_token& stop) {
            run(*following, stop, reader, wake);
            following->has_ended = true;
        });
}

void FolderFollower::stop() {
    std::erase_if(given_up_, [](const auto& following) { return following->has_ended.load(); });
    if (!now_)
        return;
    now_->thread.request_stop();
    given_up_.push_back(std::move(now_));
}

FolderFollower::View FolderFollower::view() const {
    if (!now_)
        return {};
    const std::scoped_lock lock(now_->mutex);
    return now_->view;
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
        if (stop.stop_requested()) // meanwhile: nobody asks for it any more
            return;
        pause = std::max<Clock::duration>(least_pause, pauses_a_look * (Clock::now() - begin));
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
