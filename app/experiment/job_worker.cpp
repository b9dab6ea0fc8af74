#include "app/experiment/job_worker.h"

#include "app/cli/terminal.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <system_error>
#include <thread>

namespace tessera {

namespace {

namespace fs = std::filesystem;

/// After this many claimed jobs in a row, the worker scans the folder again, but not before this multiple of the
/// last scan's duration has passed. None of the constants here is tuned.
constexpr int max_misses = 16, scan_pause_factor = 20;
/// Mean number of workers that scan a folder at the same time.
constexpr int concurrent_scans = 2;
/// After this many claimed jobs in a row, the search continues at a random position.
constexpr int misses_before_jump = 4;
/// Number of claims of other workers that are checked between two pauses. More would keep a file server busy when
/// a thousand workers wait for the last jobs.
constexpr int watched_claims = 8;

/// Removes the claims on files that exist: their workers were killed after they made the file.
void remove_leftovers(const fs::path& folder, const Listing& listing) {
    std::error_code ignored;
    for (const std::string& claim : listing.files)
        if (const std::string file = claimed_by(claim); !file.empty() && listing.files.contains(file))
            fs::remove(folder / claim, ignored);
}

} // namespace

bool Backoff::wait() {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds_));
    seconds_ = std::min({1.5 * seconds_, silence_ / 10, 1.0});
    return !interrupted();
}

JobWorker::JobWorker(JobList& jobs, double silence)
    : jobs_(jobs), silence_(silence), claims_(silence), states_(jobs.size(), State::open), open_(jobs.size()) {}

void JobWorker::set(std::size_t job, State state) {
    const auto count = [&](State s, std::size_t by) {
        open_ += s == State::open ? by : 0;
        done_ += s == State::done ? by : 0;
    };
    count(states_[job], static_cast<std::size_t>(-1));
    states_[job] = state;
    count(state, 1);
}

/// Updates the states of all jobs from the contents of the folders. The search continues at a random position if
/// other workers are active, so that workers spread over the list and each keeps the scene that it has loaded;
/// else at the first job.
void JobWorker::scan_folders() {
    const auto begin = std::chrono::steady_clock::now();
    std::map<fs::path, Listing> folders;
    bool is_alone = true;
    for (std::size_t job = 0; job < states_.size(); ++job) {
        const fs::path file = states_[job] == State::done ? fs::path() : jobs_.file_of(job);
        if (file.empty())
            continue;
        auto [folder, is_new] = folders.try_emplace(file.parent_path());
        if (is_new) {
            folder->second = list(file.parent_path()); // if that fails, attempt() checks job by job
            remove_leftovers(file.parent_path(), folder->second);
        }
        const std::string name = file.filename().string();
        const bool is_claimed = folder->second.claimed.contains(name);
        const bool is_there = folder->second.files.contains(name);
        is_alone = is_alone && !(is_claimed && !is_there);
        set(job, is_there ? State::done : is_claimed ? State::taken : State::open);
        if (is_there)
            jobs_.found(job);
    }
    if (!states_.empty())
        position_ = is_alone ? 0 : random_position();
    std::size_t workers = 0;
    for (const auto& [folder, listing] : folders)
        workers += listing.claimed.size();
    const auto end = std::chrono::steady_clock::now();
    next_scan_ = end + std::max(scan_pause_factor, static_cast<int>(workers) / concurrent_scans) * (end - begin);
}

std::size_t JobWorker::random_position() {
    return std::uniform_int_distribution<std::size_t>(0, states_.size() - 1)(random_);
}

/// Returns the next job of that state from position_ on, cyclically. There must be one.
std::size_t JobWorker::next_in(State state) {
    while (states_[position_ % states_.size()] != state)
        ++position_;
    return position_ % states_.size();
}

std::unique_ptr<Claim> JobWorker::attempt(std::size_t job) {
    position_ = job + 1;
    std::unique_ptr<Claim> claim;
    if (const fs::path file = jobs_.file_of(job); !file.empty() && !jobs_.is_done(job))
        claim = claims_.take(file);
    set(job, !claim && jobs_.is_done(job) ? State::done : State::taken);
    return claim;
}

std::unique_ptr<Claim> JobWorker::find_open() {
    for (int misses = 1; open_ > 0 && !interrupted(); ++misses) {
        if (auto claim = attempt(next_in(State::open)))
            return claim;
        if (misses >= max_misses) {
            if (std::chrono::steady_clock::now() < next_scan_)
                return {}; // nearly all jobs are done or claimed: the caller pauses
            scan_folders();
            misses = 0;
        } else if (misses >= misses_before_jump) {
            position_ = random_position(); // others have searched here: open jobs are scattered
        }
    }
    return {};
}

std::unique_ptr<Claim> JobWorker::find_silent() {
    if (open_ == 0 && states_.size() - done_ > watched_claims && std::chrono::steady_clock::now() > next_scan_) {
        scan_folders(); // most may be done: faster than job by job
        if (open_ > 0)
            return find_open();
    }
    const auto are_taken = [&] { return done_ + open_ < states_.size(); };
    for (int i = 0; i < watched_claims && are_taken(); ++i)
        if (auto claim = attempt(next_in(State::taken)))
            return claim;
    return {};
}

bool JobWorker::run(const std::function<void()>& after) {
    Backoff patience(silence_);
    for (scan_folders(); is_left();) {
        if (interrupted())
            return false;
        std::unique_ptr<Claim> claim = find_open();
        if (!claim)
            claim = find_silent();
        if (!claim && jobs_.are_all_done())
            return true;
        if (!claim) {
            patience.wait();
            continue;
        }
        const std::size_t job = (position_ + states_.size() - 1) % states_.size();
        if (!jobs_.run(job, *claim))
            return false;
        claim.reset();
        set(job, State::done);
        patience.begin_anew();
        if (is_left())
            after();
    }
    return !interrupted();
}

bool JobWorker::run_one(std::size_t job) {
    for (Backoff patience(silence_); !jobs_.is_done(job);) {
        if (const std::unique_ptr<Claim> claim = claims_.take(jobs_.file_of(job)))
            return jobs_.run(job, *claim);
        if (!patience.wait())
            return false;
    }
    return true;
}

} // namespace tessera
