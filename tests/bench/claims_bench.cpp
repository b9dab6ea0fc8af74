// claims_bench FOLDER [JOBS [WORKERS [MILLISECONDS]]]: measures the cost of dividing jobs by claims in a folder.
//
// WORKERS threads (1000), each an independent worker, do JOBS jobs (100000). A job sleeps for MILLISECONDS (0) and
// makes one file in FOLDER. FOLDER must be empty or new, and lies on the file system to be measured. Prints jobs
// per second, the pauses between two jobs of a worker, and the time of one listing of the folder.
#include "app/experiment/job_worker.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <sys/resource.h>

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Results of all workers.
struct Tally {
    std::mutex mutex;
    std::vector<double> pauses;          ///< seconds between two jobs of a worker
    std::atomic<std::size_t> done = 0;   ///< jobs run; one that two workers run counts twice
    std::atomic<std::size_t> checks = 0; ///< lookups of a job's file
};

/// Jobs that only sleep.
class Stubs final : public tessera::JobList {
public:
    Stubs(fs::path folder, std::size_t size, double seconds, Tally& tally)
        : folder_(std::move(folder)), size_(size), seconds_(seconds), tally_(tally) {}
    ~Stubs() override {
        const std::scoped_lock lock(tally_.mutex);
        tally_.pauses.insert(tally_.pauses.end(), pauses_.begin(), pauses_.end());
    }

    std::size_t size() const override { return size_; }
    fs::path file_of(std::size_t job) override {
        return folder_ / fmt::format("scene-1a2b3c4d-seed{}.jsonl", job);
    }
    bool is_done(std::size_t job) override {
        ++tally_.checks;
        return fs::exists(file_of(job));
    }
    bool are_all_done() override { return fs::exists(folder_ / "report"); }
    bool run(std::size_t, tessera::Claim& claim) override {
        if (has_begun_)
            pauses_.push_back(seconds_since(end_));
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds_));
        ++tally_.done;
        end_ = Clock::now(); // the pause includes writing the result
        has_begun_ = true;
        claim.finish("");
        return true;
    }

private:
    fs::path folder_;
    std::size_t size_;
    double seconds_;
    Tally& tally_;
    std::vector<double> pauses_;
    bool has_begun_ = false;
    Clock::time_point end_;
};

double quantile(const std::vector<double>& sorted, double fraction) {
    return sorted.empty() ? 0
                          : sorted[static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1))];
}

double cpu_seconds() {
    rusage u{};
    getrusage(RUSAGE_SELF, &u);
    const auto seconds = [](timeval t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(u.ru_utime) + seconds(u.ru_stime);
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "claims_bench FOLDER [JOBS [WORKERS [MILLISECONDS]]]\n");
        return 2;
    }
    const fs::path folder = argv[1];
    const auto jobs = static_cast<std::size_t>(argc > 2 ? std::atoi(argv[2]) : 100000);
    const int workers = argc > 3 ? std::atoi(argv[3]) : 1000;
    const double seconds = argc > 4 ? 1e-3 * std::atof(argv[4]) : 0;
    // Long enough that threads that wait for a core are not taken for dead.
    constexpr double silence = 600;
    fs::create_directories(folder);
    Tally tally;
    const Clock::time_point begin = Clock::now();
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < workers; ++i)
            threads.emplace_back([&] {
                Stubs stubs(folder, jobs, seconds, tally);
                tessera::JobWorker(stubs, silence).run([] {});
                std::ofstream(folder / "report") << "\n"; // marks all jobs as done
            });
    }
    const double all = seconds_since(begin);
    std::sort(tally.pauses.begin(), tally.pauses.end());
    fmt::print("{} jobs by {} workers: {} done in {:.1f} s, {:.0f} a second; {:.1f} CPU s\n", jobs, workers,
               tally.done.load(), all, static_cast<double>(tally.done) / all, cpu_seconds());
    fmt::print(
        "between two jobs: median {:.2g} ms, 99 % below {:.3g} ms, at most {:.3g} ms; {:.2g} file lookups per "
        "job\n",
        1e3 * quantile(tally.pauses, 0.5), 1e3 * quantile(tally.pauses, 0.99), 1e3 * quantile(tally.pauses, 1),
        static_cast<double>(tally.checks) / static_cast<double>(jobs));
    const Clock::time_point listing_begin = Clock::now();
    const auto files = std::distance(fs::directory_iterator(folder), fs::directory_iterator());
    fmt::print("one listing of the folder ({} files): {:.3g} ms\n", files, 1e3 * seconds_since(listing_begin));
    return 0;
}
