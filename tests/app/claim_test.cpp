// Claims: one of many processes does a job, another takes over if it is killed, and each process uses only its own
// clock.
#include "app/experiment/claim.h"
#include "app/experiment/job_worker.h"
#include "tests/app/program.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/eventually.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class ClaimedFile : public testing::Test {
protected:
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_.path()))
            names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }
    std::string text(const fs::path& file) const {
        std::ifstream in(file);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    /// Forks a process that claims the file and calls `then`. Returns after the claim.
    pid_t claim_in_another_process(const std::function<void(Claim&)>& then) const {
        const pid_t child = fork();
        if (child == 0) {
            const std::unique_ptr<Claim> claim = Claims(silence_).take(file_);
            if (claim)
                then(*claim);
            _exit(claim ? 0 : 1);
        }
        EXPECT_TRUE(eventually([&] { return !Claims::owner_of(file_).empty(); }));
        return child;
    }

    static constexpr double silence_ = 0.5; // silence after which a claim can be taken over, seconds
    TemporaryFolder folder_;
    fs::path file_ = folder_.path() / "job";
};

TEST_F(ClaimedFile, IsMadeByOneProcess) {
    Claims mine(60), others(60);
    std::unique_ptr<Claim> claim = mine.take(file_);
    ASSERT_TRUE(claim);
    EXPECT_FALSE(others.take(file_));
    EXPECT_EQ(Claims::owner_of(file_), worker_name());
    EXPECT_THAT(names(), ElementsAre("job.claim"));
    claim->finish("found\n");
    EXPECT_THAT(names(), ElementsAre("job"));
    EXPECT_THAT(text(file_), testing::EndsWith("}\nfound\n"));
    EXPECT_THAT(text(file_), HasSubstr(worker_name())) << "the file names its worker";
    claim.reset();
    EXPECT_FALSE(others.take(file_)) << "the file exists";
    EXPECT_THAT(names(), ElementsAre("job"));
}

TEST_F(ClaimedFile, IsReleasedIfItIsNotMade) {
    Claims mine(60), others(60);
    std::unique_ptr<Claim> claim = mine.take(file_);
    claim.reset();
    EXPECT_THAT(names(), IsEmpty());
    EXPECT_TRUE(others.take(file_));
    EXPECT_THAT(names(), IsEmpty());
}

TEST_F(ClaimedFile, PassesFromAKilledProcessToOneOther) {
    const pid_t child = claim_in_another_process([](Claim&) { pause(); });
    const std::string dead = Claims::owner_of(file_);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    std::vector<Claims> others(4, Claims(silence_));
    std::vector<std::unique_ptr<Claim>> taken;
    EXPECT_TRUE(eventually([&] {
        for (Claims& one : others)
            if (auto claim = one.take(file_))
                taken.push_back(std::move(claim));
        return !taken.empty();
    }));
    for (Claims& one : others)
        EXPECT_FALSE(one.take(file_));
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_THAT(names(), ElementsAre("job.claim", "job.claim2"));
    EXPECT_NE(Claims::owner_of(file_), dead);
    taken.front()->finish("");
    EXPECT_THAT(names(), ElementsAre("job"));
}

TEST_F(ClaimedFile, PassesOnAfterTwoKills) {
    folder_.write("job.claim", "torn");
    folder_.write("job.claim2", "");
    Claims claims(0.05);
    std::unique_ptr<Claim> claim;
    EXPECT_TRUE(eventually([&] { return (claim = claims.take(file_)) != nullptr; }));
    EXPECT_THAT(names(), ElementsAre("job.claim", "job.claim2", "job.claim3"));
    claim.reset();
    EXPECT_THAT(names(), IsEmpty());
}

TEST_F(ClaimedFile, StaysWithALivingProcess) {
    const pid_t child = claim_in_another_process([](Claim&) { pause(); });
    Claims claims(0.001); // the silence stated in the claim applies instead
    using namespace std::chrono;
    int refused = 0;
    for (const auto end = steady_clock::now() + seconds(2); steady_clock::now() < end; ++refused) {
        ASSERT_FALSE(claims.take(file_));
        std::this_thread::sleep_for(milliseconds(20));
    }
    EXPECT_GT(refused, 1);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
}

/// File times come from the file server or another host, so they are ignored.
TEST_F(ClaimedFile, IgnoresFileTimes) {
    for (const int hours : {-1, 1}) {
        folder_.write("job.claim", "{\"worker\":\"other\",\"silence\":0.3,\"beat\":\"0000000001\"}\n");
        fs::last_write_time(folder_.path() / "job.claim",
                            fs::file_time_type::clock::now() + std::chrono::hours(hours));
        Claims claims(60);
        const auto begin = std::chrono::steady_clock::now();
        EXPECT_FALSE(claims.take(file_)) << "the process may live, whatever the file time";
        EXPECT_TRUE(eventually([&] { return claims.take(file_) != nullptr; }));
        EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(300));
    }
}

/// A process is suspended for long, and another process does its job.
TEST_F(ClaimedFile, IsMadeOnceIfTwoProcessesClaimIt) {
    const pid_t child = claim_in_another_process([](Claim& claim) {
        raise(SIGSTOP);
        claim.finish("late\n");
    });
    waitpid(child, nullptr, WUNTRACED);
    Claims claims(silence_);
    std::unique_ptr<Claim> claim;
    EXPECT_TRUE(eventually([&] { return (claim = claims.take(file_)) != nullptr; }));
    claim->finish("sooner\n");
    kill(child, SIGCONT);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    EXPECT_THAT(names(), ElementsAre("job"));
    EXPECT_THAT(text(file_), testing::EndsWith("}\nsooner\n"));
}

TEST_F(ClaimedFile, ReportsAnUnwritableFolder) {
    try {
        Claims(60).take(folder_.path() / "none/job");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("none/job.claim: cannot be written: No such file"));
    }
}

TEST(ClaimName, GivesTheNameOfTheClaimedFile) {
    EXPECT_EQ(claimed_by("job.claim"), "job");
    EXPECT_EQ(claimed_by("job.claim12"), "job");
    EXPECT_EQ(claimed_by("job.claims"), "");
    EXPECT_EQ(claimed_by("job"), "");
}

/// Jobs that count their runs. Every seventh job waits for the previous one.
class CountedJobs final : public JobList {
public:
    CountedJobs(fs::path folder, std::vector<std::atomic<int>>& counts)
        : folder_(std::move(folder)), counts_(counts) {}
    std::size_t size() const override { return counts_.size(); }
    fs::path file_of(std::size_t job) override {
        const bool must_wait = job % 7 == 6 && !is_done(job - 1);
        return must_wait ? fs::path() : folder_ / std::to_string(job);
    }
    bool is_done(std::size_t job) override { return fs::exists(folder_ / std::to_string(job)); }
    bool run(std::size_t job, Claim& claim) override {
        ++counts_[job];
        claim.finish("");
        return true;
    }

private:
    fs::path folder_;
    std::vector<std::atomic<int>>& counts_;
};

TEST(JobWorkers, DoEachJobOnce) {
    const TemporaryFolder folder;
    folder.write("3.claim", "left by one that was killed");
    folder.write("40", "done before");
    folder.write("40.claim", "whose claim was left");
    std::vector<std::atomic<int>> counts(200);
    std::atomic<int> ended = 0;
    {
        std::vector<std::jthread> workers;
        for (int i = 0; i < 8; ++i)
            workers.emplace_back([&] {
                CountedJobs jobs(folder.path(), counts);
                ended += JobWorker(jobs, 1).run([] {});
            });
    }
    EXPECT_EQ(ended, 8) << "every worker waits until all jobs are done";
    for (std::size_t job = 0; job < counts.size(); ++job)
        EXPECT_EQ(counts[job], job == 40 ? 0 : 1) << job;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 200)
        << "no claim is left";
}

/// A thousand jobs. Running the first one also writes the files of the rest, as other workers do.
class DoneByOthers final : public JobList {
public:
    explicit DoneByOthers(fs::path folder) : folder_(std::move(folder)) {}
    std::size_t size() const override { return 1000; }
    fs::path file_of(std::size_t job) override { return folder_ / ("job" + std::to_string(job)); }
    bool is_done(std::size_t job) override { return fs::exists(file_of(job)); }
    bool run(std::size_t job, Claim& claim) override {
        ++runs;
        for (std::size_t other = 0; other < size(); ++other)
            if (other != job)
                std::ofstream(file_of(other)) << "\n";
        claim.finish("");
        return true;
    }
    int runs = 0;

private:
    fs::path folder_;
};

TEST(JobWorker, EndsIfOthersHaveDoneTheRest) {
    const TemporaryFolder folder;
    DoneByOthers jobs(folder.path());
    EXPECT_TRUE(JobWorker(jobs, 60).run([] {}));
    EXPECT_EQ(jobs.runs, 1);
}

} // namespace

} // namespace tessera::test
