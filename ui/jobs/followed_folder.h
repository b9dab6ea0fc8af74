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

/// A piece of work in a folder that processes share.
struct FollowedJob {
    enum class State : std::uint8_t { waiting, claimed, done };

    std::string what; ///< "box, seed 3, tile 4"
    State state = State::waiting;
    std::string worker{}; ///< of a claimed one: who does it, as far as that is known

    bool operator==(const FollowedJob&) const = default;
};

/// What such a folder holds so far.
struct FollowedFolder {
    std::string command;              ///< "sweep"
    std::vector<FollowedJob> jobs;    ///< in their order
    std::vector<Chart> charts;        ///< of what is done
    std::vector<std::string> trouble; ///< files that could not be read, and why

    std::size_t count(FollowedJob::State state) const;
};

/// Looks at a folder again and again, on a thread other than the UI's. Empty: nothing has changed since the last
/// time. Throws std::exception, whose what() is shown, where it is no such folder, or not yet.
using FolderReader = std::function<std::shared_ptr<const FollowedFolder>()>;

/// Makes the reader of a folder; called from the UI's thread, and touches no file.
using FolderOpener = std::function<FolderReader(const std::filesystem::path&)>;

/// Follows one folder in the background. Nothing waits for a look under way, which may hang with its server, but
/// the end.
class FolderFollower {
public:
    ~FolderFollower() { stop(); } // all of them, before the first is waited for

    /// What is known now.
    struct View {
        std::filesystem::path folder;                 ///< empty: none is followed
        std::shared_ptr<const FollowedFolder> seen{}; ///< null: nothing yet
        std::string error{};                          ///< of the last look; empty: there was none
    };

    /// Follows that folder from now on. `wake` is called from another thread when there is something new.
    void follow(const std::filesystem::path& folder, FolderReader reader, std::function<void()> wake);
    /// Gives the folder up.
    void stop();

    View view() const;

private:
    struct Following {
        mutable std::mutex mutex; // of the next
        View view;
        std::atomic<bool> has_ended = false;
        std::jthread thread; // last: ends first
    };
    static void run(Following& following, const std::stop_token& stop, const FolderReader& reader,
                    const std::function<void()>& wake);

    std::unique_ptr<Following> now_;                   // null: no folder is followed
    std::vector<std::unique_ptr<Following>> given_up_; // until their looks have ended
};

} // namespace tessera
