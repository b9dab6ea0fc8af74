#include "ui/jobs/followed_folder.h"

#include "render/io/available_memory.h"

#include <stop_token>
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
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
    view_ = {folder};
    thread_ = std::jthread([this, reader = std::move(reader),
                            wake = std::move(wake)](const std::stop_token& stop) { run(stop, reader, wake); });
}

void FolderFollower::stop() {
    thread_ = {};
    view_ = {};
}

FolderFollower::View FolderFollower::view() const {
    const std::scoped_lock lock(mutex_);
    return view_;
}

void FolderFollower::run(const std::stop_token& stop, const FolderReader& reader,
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
        pause = std::max<Clock::duration>(least_pause, pauses_a_look * (Clock::now() - begin));
        {
            const std::scoped_lock lock(mutex_);
            if (!seen && error == view_.error)
                continue;
            if (seen)
                view_.seen = std::move(seen);
            view_.error = error;
        }
        if (wake)
            wake();
    }
}

} // namespace tessera
