// Several processes share one folder. They divide the jobs, give the results of one process, and continue if one
// is killed.
#include "render/io/exr.h"
#include "tests/app/program.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/eventually.h"

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class SharedFolder : public testing::Test {
protected:
    void SetUp() override {
        fs::copy_file(fs::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml", folder() / "box.xml");
        fs::copy_file(fs::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml", folder() / "other.xml");
    }
    const fs::path& folder() const { return folder_.path(); }
    std::string text(const fs::path& name) const {
        std::ifstream in(folder() / name);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    /// Returns the results of sweep.json without times and machines.
    json rows(const fs::path& output) const {
        json rows = json::parse(text(output / "sweep.json"))["results"];
        for (json& row : rows) {
            for (const char* other : {"cpu_seconds", "cpu_seconds_deviation", "reconstruction_cpu_seconds",
                                      "wall_seconds", "megasamples_per_wall_second", "efficiency", "machine"})
                row.erase(other);
            for (json& run : row["runs"])
                for (const char* other : {"cpu_seconds", "reconstruction_cpu_seconds", "wall_seconds", "machine"})
                    run.erase(other);
        }
        return rows;
    }
    std::vector<std::string> job_files(const fs::path& output) const {
        std::vector<std::string> files;
        for (const auto& entry : fs::directory_iterator(folder() / output / "jobs"))
            if (entry.path().filename() != "plan.json")
                files.push_back(entry.path().filename());
        return files;
    }
    pid_t start(const std::string& arguments) const {
        const pid_t child = fork();
        if (child == 0) {
            const std::string command = "cd '" + folder().string() + "' && exec '" + TESSERA_BINARY + "' " +
                                        arguments + " 2>> log.txt >> log.txt";
            execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
            _exit(101);
        }
        return child;
    }
    static int code_of(pid_t child) {
        int status = 0;
        waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    const std::string sweep_ = "sweep box.xml other.xml -m gpr,pt --vary tile=2,3 --seeds 3 --size 32x18 --spp 4 "
                               "--reference-spp 32 --threads 1 --silence 1 ";
    TemporaryFolder folder_;
};

TEST_F(SharedFolder, ManyProcessesGiveTheResultsOfOne) {
    ASSERT_EQ(run(folder(), sweep_ + "--reference refs -o one").exit_code, 0);
    std::vector<pid_t> workers;
    for (int i = 0; i < 4; ++i)
        workers.push_back(start(sweep_ + "--reference refs-of-many -o many"));
    for (const pid_t worker : workers)
        EXPECT_EQ(code_of(worker), 0) << text("log.txt");
    EXPECT_EQ(rows("many"), rows("one"));
    EXPECT_EQ(job_files("many").size(), 18u + 1)
        << "one file per job, and a mark of the report: " << testing::PrintToString(job_files("many"));
    const std::string log = text("log.txt");
    std::size_t references = 0;
    for (std::size_t at = 0; (at = log.find("is missing: rendering it", at)) != log.npos; ++at)
        ++references;
    EXPECT_EQ(references, 2u) << "one per scene";
}

TEST_F(SharedFolder, OthersContinueIfOneIsKilled) {
    ASSERT_EQ(run(folder(), sweep_ + "--reference refs -o one").exit_code, 0);
    const std::string many = sweep_ + "--reference refs -o many";
    const pid_t first = start(many);
    EXPECT_TRUE(eventually([&] { return fs::exists(folder() / "many/jobs") && !job_files("many").empty(); }));
    kill(first, SIGKILL);
    waitpid(first, nullptr, 0);
    const pid_t second = start(many), third = start(many);
    EXPECT_EQ(code_of(second), 0);
    EXPECT_EQ(code_of(third), 0);
    EXPECT_EQ(rows("many"), rows("one"));
    EXPECT_EQ(job_files("many").size(), 18u + 1) << testing::PrintToString(job_files("many"));
}

TEST_F(SharedFolder, JobArrayDoesAllJobsAndTheLastReports) {
    ASSERT_EQ(run(folder(), sweep_ + "--reference refs -o one").exit_code, 0);
    const std::string many = sweep_ + "--reference refs -o many ";
    const Outcome list = run(folder(), many + "--list");
    EXPECT_EQ(list.exit_code, 0);
    EXPECT_EQ(std::count(list.output.begin(), list.output.end(), '\n'), 18) << list.output;
    EXPECT_THAT(list.output, HasSubstr("1\topen\t-\tbox, seed 0, tile 2\n"));
    EXPECT_THAT(list.output, HasSubstr("18\topen\t-\tother, seed 2\n"));
    for (int job = 18; job >= 1; --job) {
        EXPECT_FALSE(fs::exists(folder() / "many/sweep.csv"));
        EXPECT_EQ(run(folder(), many + "--job " + std::to_string(job)).exit_code, 0);
    }
    EXPECT_EQ(rows("many"), rows("one"));
    EXPECT_THAT(run(folder(), many + "--list").output, HasSubstr("\n18\tdone\t"));
    const Outcome none = run(folder(), many + "--job 19");
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.output, HasSubstr("--job 19: there are 18 jobs"));
}

TEST_F(SharedFolder, ReportsFinishedJobs) {
    const std::string sweep = sweep_ + "--reference refs -o out ";
    ASSERT_EQ(run(folder(), sweep + "--job 2").exit_code, 0);
    const Outcome o = run(folder(), sweep + "--report");
    EXPECT_EQ(o.exit_code, 1) << o.output;
    EXPECT_THAT(o.output, HasSubstr("not complete, 17 of 18 jobs are left"));
    EXPECT_THAT(o.output, Not(HasSubstr("rendering")));
    EXPECT_EQ(json::parse(text("out/sweep.json"))["results"].size(), 1u);
}

/// Times of different machines are not comparable.
TEST_F(SharedFolder, SeparatesMachines) {
    const std::string sweep = "sweep box.xml -m gpr,pt --seeds 3 --size 32x18 --spp 2 --reference refs "
                              "--reference-spp 2 --threads 1 -o out ";
    for (const char* job : {"--machine slow --job 1", "--machine fast/2 --job 2", "--machine fast/2 --job 3"})
        ASSERT_EQ(run(folder(), sweep + job).exit_code, 0);
    const json apart = json::parse(text("out/sweep.json"))["results"];
    ASSERT_EQ(apart.size(), 4u);
    EXPECT_EQ(apart[0]["machine"], "fast/2");
    EXPECT_EQ(apart[0]["runs"].size(), 2u);
    EXPECT_EQ(apart[2]["machine"], "slow");
    EXPECT_EQ(apart[2]["runs"].size(), 1u);
    EXPECT_THAT(text("out/sweep.md"), HasSubstr("| box (slow) | gpr-weighted |"));
    EXPECT_TRUE(fs::exists(folder() / "out/sweep-box (fast_2).svg"));
    ASSERT_EQ(run(folder(), sweep + "--any-machine").exit_code, 0);
    const json together = json::parse(text("out/sweep.json"))["results"];
    ASSERT_EQ(together.size(), 2u);
    EXPECT_EQ(together[0]["machine"], "fast/2; slow");
    EXPECT_EQ(together[0]["runs"].size(), 3u);
    EXPECT_THAT(text("out/sweep.csv"), HasSubstr(",fast/2; slow\n"));
}

/// Errors at a time limit depend on the load of the machine, so all compared setups form one job.
TEST_F(SharedFolder, TimeLimitMakesAllSetupsOneJob) {
    const std::string rest = " --vary tile=2,3 --seeds 2 --size 32x18 --reference refs -o out --list";
    EXPECT_EQ(run(folder(), "sweep box.xml -m gpr,pt --time 3" + rest).output,
              "1\topen\t9 s\tbox, seed 0\n2\topen\t9 s\tbox, seed 1\n");
}

TEST_F(SharedFolder, ErrorsNameDamagedFiles) {
    const std::string sweep = sweep_ + "--reference refs -o out ";
    ASSERT_EQ(run(folder(), sweep).exit_code, 0);
    std::string name;
    for (const std::string& file : job_files("out"))
        if (file.starts_with("box-2-") && file.ends_with("-seed1.jsonl"))
            name = "out/jobs/" + file;
    folder_.write(name, text(name).substr(0, 1000));
    const Outcome o = run(folder(), sweep);
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_THAT(o.output, HasSubstr(name + ": is damaged; delete it to run the job again"));
    fs::remove(folder() / name);
    EXPECT_EQ(run(folder(), sweep).exit_code, 0);
}

TEST_F(SharedFolder, FullDiskKeepsFinishedJobs) {
    const fs::path disk = folder() / "disk";
    fs::create_directory(disk);
    if (mount("none", disk.c_str(), "tmpfs", 0, "size=48k") != 0)
        GTEST_SKIP() << "only root can make a small disk";
    const std::string sweep = sweep_ + "--reference refs -o disk/out";
    const Outcome full = run(folder(), sweep);
    EXPECT_EQ(full.exit_code, 2) << full.output;
    EXPECT_THAT(full.output, HasSubstr(": cannot be written")); // a job or the report
    std::map<std::string, std::string> before;
    for (const std::string& file : job_files("disk/out")) {
        EXPECT_TRUE(file.ends_with(".jsonl")) << file << " is left over";
        before[file] = text("disk/out/jobs/" + file);
    }
    EXPECT_GE(before.size(), 1u);
    ASSERT_EQ(mount("none", disk.c_str(), "tmpfs", MS_REMOUNT, "size=8m"), 0);
    const Outcome o = run(folder(), sweep);
    EXPECT_EQ(o.exit_code, 0) << o.output;
    for (const auto& [file, lines] : before)
        EXPECT_EQ(text("disk/out/jobs/" + file), lines) << "it is not rendered again";
    umount(disk.c_str());
}

} // namespace

} // namespace tessera::test
