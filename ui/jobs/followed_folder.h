#pragma once

#include "ui/charts/chart.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace tessera {

/// One job of a folder whose jobs are divided among processes.
struct FollowedJob {
    enum class State : std::uint8_t { waiting, claimed, done };

    std::string what; ///< "box, seed 3, tile 4"
    State state = State::waiting;
    std::string worker{}; ///< process that has claimed the job; empty: unknown

    bool operator==(const FollowedJob&) const = default;
};

/// The contents of a folder of jobs.
struct FollowedFolder {
    std::string command;              ///< command that made the folder, such as "sweep"
    std::vector<FollowedJob> jobs;    ///< in the order of the experiment
    std::vector<Chart> charts;        ///< results of the jobs that are done
    std::vector<std::string> trouble; ///< files that could not be read, with the reason

    std::size_t count(FollowedJob::State state) const;
};

/// Reads the folder; called repeatedly, from a thread other than the UI's. Returns null if nothing has changed
/// since the last call. Throws std::exception, whose what() is shown, if the folder is not yet a folder of jobs.
using FolderReader = std::function<std::shared_ptr<const FollowedFolder>()>;

/// Makes the reader of a folder. Called from the UI's thread, so it must not access files.
using FolderOpener = std::function<FolderReader(const std::filesystem::path&)>;

/// Reads one folder repeatedly in the background. Only the destructor waits for a read under way, which can hang
/// with its file server.
class FolderFollower {
public:
    ~FolderFollower() { stop(); } // all threads are requested to stop before the first is joined

    struct View {
        std::filesystem::path folder;                 ///< empty: none is followed
        std::shared_ptr<const FollowedFolder> seen{}; ///< null: not read yet
        std::string error{};                          ///< of the last read; empty: it succeeded
    };

    /// Follows this folder instead of the current one. `wake` is called from another thread when view() has
    /// changed.
    void follow(const std::filesystem::path& folder, FolderReader reader, std::function<void()> wake);
    /// Stops to follow the folder.
    void stop();

    View view() const;

private:
    struct Following {
        mutable std::mutex mutex; // guards `view`
        View view;
        std::atomic<bool> has_ended = false;
        std::jthread thread; // last, so that it is joined before the other members are destroyed
    };
    static void run(Following& following, const std::stop_token& stop, const FolderReader& reader,
                    const std::function<void()>& wake);

    std::unique_ptr<Following> current_;              // null: no folder is followed
    std::vector<std::unique_ptr<Following>> stopped_; // until their reads have ended
};

} // namespace tessera
