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

/// So many jobs in a row that others have, and it is time to look at the whole folder instead; but not before so
/// many times as long has passed as the last look took: till then there are pauses.
constexpr int most_misses = 16, pauses_a_look = 20;
/// Of many workers, so many look at the same time.
constexpr int looks_at_once = 2;
/// So many in a row, and the next ones are tried elsewhere.
constexpr int misses_in_place = 4;
/// Of the jobs that others do, so many are looked at before the next pause: a thousand that wait for the last ones
/// would otherwise keep a file server busy.
constexpr int watched_at_once = 8;

/// Claims of files that are there are of workers that were killed before they took them away.
void remove_leftovers(const fs::path& folder, const Listing& listing) {
    std::error_code ignored;
    for (const std::string& claim : listing.files)
        if (const std::string file = claimed_by(claim); !file.empty() && listing.files.contains(file))
            fs::remove(folder / claim, ignored);
}

} // namespace

bool Patience::wait() {
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

/// Finds out which jobs are done or taken from what the folders hold. Where others are at work this one goes on
/// from anywhere, so that they spread over the list, and each stays with a scene that it has loaded; else from the
/// first.
void JobWorker::look() {
    const auto begin = std::chrono::steady_clock::now();
    std::map<fs::path, Listing> folders;
    bool is_alone = true;
    for (std::size_t job = 0; job < states_.size(); ++job) {
        const fs::path file = states_[job] == State::done ? fs::path() : jobs_.file_of(job);
        if (file.empty())
            continue;
        auto [folder, is_new] = folders.try_emplace(file.parent_path());
        if (is_new) {
            folder->second = list(file.parent_path()); // what cannot be listed is found out job by job
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
        place_ = is_alone ? 0 : anywhere();
    std::size_t workers = 0;
    for (const auto& [folder, listing] : folders)
        workers += listing.claimed.size();
    const auto end = std::chrono::steady_clock::now();
    next_look_ = end + std::max(pauses_a_look, static_cast<int>(workers) / looks_at_once) * (end - begin);
}

std::size_t JobWorker::anywhere() {
    return std::uniform_int_distribution<std::size_t>(0, states_.size() - 1)(chance_);
}

/// The next one of that state, from place_ on and round; there must be one.
std::size_t JobWorker::next(State state) {
    while (states_[place_ % states_.size()] != state)
        ++place_;
    return place_ % states_.size();
}

std::unique_ptr<Claim> JobWorker::attempt(std::size_t job) {
    place_ = job + 1;
    std::unique_ptr<Claim> claim;
    if (const fs::path file = jobs_.file_of(job); !file.empty() && !jobs_.is_done(job))
        claim = claims_.take(file);
    set(job, !claim && jobs_.is_done(job) ? State::done : State::taken);
    return claim;
}

std::unique_ptr<Claim> JobWorker::find_open() {
    for (int misses = 1; open_ > 0 && !interrupted(); ++misses) {
        if (auto claim = attempt(next(State::open)))
            return claim;
        if (misses >= most_misses) {
            if (std::chrono::steady_clock::now() < next_look_)
                return {}; // nearly all is done or taken: a pause, so that a file server has one
            look();
            misses = 0;
        } else if (misses >= misses_in_place) {
            place_ = anywhere(); // others have gone through here: open jobs lie scattered
        }
    }
    return {};
}

std::unique_ptr<Claim> JobWorker::find_silent() {
    if (open_ == 0 && states_.size() - done_ > watched_at_once && std::chrono::steady_clock::now() > next_look_) {
        look(); // most may be done by now, which to find out one by one would take long
        if (open_ > 0)
            return find_open();
    }
    const auto are_taken = [&] { return done_ + open_ < states_.size(); };
    for (int i = 0; i < watched_at_once && are_taken(); ++i)
        if (auto claim = attempt(next(State::taken)))
            return claim;
    return {};
}

bool JobWorker::run(const std::function<void()>& after) {
    Patience patience(silence_);
    for (look(); is_left();) {
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
        const std::size_t job = (place_ + states_.size() - 1) % states_.size();
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
    for (Patience patience(silence_); !jobs_.is_done(job);) {
        if (const std::unique_ptr<Claim> claim = claims_.take(jobs_.file_of(job)))
            return jobs_.run(job, *claim);
        if (!patience.wait())
            return false;
    }
    return true;
}

} // namespace tessera
