// The viewer follows a folder of workers: it shows jobs and curves as they appear, and reports folders that it
// cannot follow.
#include "app/experiment/claim.h"
#include "app/experiment/plan.h"
#include "app/report/reports.h"
#include "tests/app/program.h"
#include "tests/load/temporary_folder.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using State = FollowedJob::State;
using testing::HasSubstr;

class FollowedFolderTest : public testing::Test {
protected:
    const fs::path& folder() const { return folder_.path(); }
    std::string text(const fs::path& name) const {
        std::ifstream in(folder() / name);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    /// Runs a sweep of a reference and six jobs into "out", with these additional arguments.
    void sweep(const std::string& more) const {
        const Outcome o = run(folder(), "sweep '" + std::string(TESSERA_SOURCE_DIR) +
                                            "/assets/cornell-box.xml' --vary tile=2,4 -m pr,gpr --seeds 3 --spp 2 "
                                            "--reference-spp 8 --size 16x16 --threads 1 -o out " +
                                            more);
        ASSERT_EQ(o.exit_code, 0) << o.output;
    }
    static std::string refusal(const FolderReader& reader) {
        try {
            reader();
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "not refused";
    }

    TemporaryFolder folder_;
};

TEST_F(FollowedFolderTest, ShowsJobsAsTheyAreClaimedAndDone) {
    const FolderReader reader = folder_reader(folder() / "out");
    EXPECT_THAT(refusal(reader), HasSubstr("out: there is no such folder"));
    sweep("--job 2");
    std::shared_ptr<const FollowedFolder> seen = reader();
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->command, "sweep");
    ASSERT_EQ(seen->jobs.size(), 7u) << "the reference, and one job per seed and tile";
    EXPECT_EQ(seen->jobs[0], (FollowedJob{"reference cornell-box-16x16-d8.exr", State::done}));
    EXPECT_EQ(seen->jobs[1], (FollowedJob{"cornell-box, seed 0, tile 2", State::waiting}));
    EXPECT_EQ(seen->jobs[2], (FollowedJob{"cornell-box, seed 0, tile 4", State::done}));
    EXPECT_EQ(seen->count(State::done), 2u);
    ASSERT_EQ(seen->charts.size(), 1u);
    EXPECT_FALSE(reader()) << "nothing has changed";

    const JobPlan plan = read_plan(plan_file(folder() / "out"));
    Claims claims(60);
    std::unique_ptr<Claim> claim = claims.take(folder() / "out" / plan.jobs[1].file);
    seen = reader();
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->jobs[1], (FollowedJob{"cornell-box, seed 0, tile 2", State::claimed, worker_name()}));
    claim.reset();
    seen = reader();
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->jobs[1].state, State::waiting);
}

TEST_F(FollowedFolderTest, ShowsTheCurvesOfTheReport) {
    sweep("--job 1");
    const FolderReader reader = folder_reader(folder() / "out");
    const std::string of_one = to_svg(reader()->charts.at(0));
    sweep("");
    const std::shared_ptr<const FollowedFolder> seen = reader();
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->count(State::done), 7u);
    EXPECT_EQ(to_svg(seen->charts.at(0)), text("out/sweep-cornell-box.svg"));
    EXPECT_NE(to_svg(seen->charts.at(0)), of_one);
    EXPECT_TRUE(seen->trouble.empty());
}

/// A sweep with more seeds replaces the list of jobs, and keeps the finished ones.
TEST_F(FollowedFolderTest, FollowsAnotherListOfJobs) {
    sweep("");
    const FolderReader reader = folder_reader(folder() / "out");
    EXPECT_EQ(reader()->jobs.size(), 7u);
    sweep("--seeds 4 --job 7");
    std::shared_ptr<const FollowedFolder> seen = reader();
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->jobs.size(), 9u);
    EXPECT_EQ(seen->count(State::done), 8u);
    // A sweep with fewer methods has its own list, and its jobs are finished.
    sweep("-m gpr --list");
    EXPECT_FALSE(reader()) << "a list that is only printed changes nothing";
    sweep("-m gpr");
    seen = reader();
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->count(State::done), 7u);
    EXPECT_EQ(to_svg(seen->charts.at(0)), text("out/sweep-cornell-box.svg"));
}

TEST_F(FollowedFolderTest, ReportsFoldersWithoutJobs) {
    folder_.write("file", "");
    fs::create_directories(folder() / "foreign/jobs");
    EXPECT_THAT(refusal(folder_reader(folder() / "file")), HasSubstr("file: is not a folder"));
    EXPECT_THAT(
        refusal(folder_reader(folder() / "foreign")),
        HasSubstr("foreign: no tessera bench, sweep or stability of this version has started in this folder"));
    std::ofstream(folder() / "foreign/jobs/plan.json") << "{\"plan\":1,\n\"works\":[3],\"jobs\":[]}";
    EXPECT_THAT(refusal(folder_reader(folder() / "foreign")), HasSubstr("plan.json: is not a list of jobs"));
}

TEST_F(FollowedFolderTest, ReportsWhichFileIsDamaged) {
    sweep("");
    const JobPlan plan = read_plan(plan_file(folder() / "out"));
    const fs::path job = folder() / "out" / plan.jobs[1].file;
    const std::string whole = text(job);
    std::ofstream(job) << whole.substr(0, whole.find("\"measurements\"")) << "\"measurements\":3}}\n";
    const std::shared_ptr<const FollowedFolder> seen = folder_reader(folder() / "out")();
    ASSERT_TRUE(seen);
    ASSERT_EQ(seen->trouble.size(), 1u);
    EXPECT_THAT(seen->trouble[0], HasSubstr(job.string()));
    EXPECT_FALSE(seen->charts.empty());
}

TEST_F(FollowedFolderTest, RecoversWhenADamagedFileIsRepaired) {
    sweep("");
    const fs::path plan_path = plan_file(folder() / "out");
    const fs::path job = folder() / "out" / read_plan(plan_path).jobs[1].file;
    const std::string plan = text(plan_path), found = text(job);
    std::ofstream(job) << found.substr(0, found.find("\"measurements\"")) << "\"measurements\":3}}\n";
    const FolderReader reader = folder_reader(folder() / "out");
    std::shared_ptr<const FollowedFolder> seen = reader();
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->trouble.size(), 1u);
    std::ofstream(plan_path) << "{\"plan\":1,\n\"works\":[3],\"jobs\":[]}";
    EXPECT_THAT(refusal(reader), HasSubstr("is not a list of jobs"));
    EXPECT_THAT(refusal(reader), HasSubstr("is not a list of jobs")) << "the error repeats";
    std::ofstream(plan_path) << plan;
    std::ofstream(job) << found;
    seen = reader();
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->jobs.size(), 7u);
    EXPECT_TRUE(seen->trouble.empty());
    EXPECT_EQ(to_svg(seen->charts.at(0)), text("out/sweep-cornell-box.svg"));
}

} // namespace

} // namespace tessera::test
