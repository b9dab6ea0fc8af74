// `tessera sweep`: renders, written files and rejected input.
#include "app/experiment/result.h"
#include "render/io/exr.h"
#include "render/run/reference_image.h"
#include "tests/app/program.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/eventually.h"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class SweepCommand : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder() / "box");
        fs::copy_file(fs::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml", folder() / "box/scene.xml");
        fs::copy_file(fs::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml", folder() / "other.xml");
    }

    const fs::path& folder() const { return folder_.path(); }
    fs::path reference(const std::string& scene = "box", int depth = 8) const {
        return folder() / "refs" / (scene + "-32x18-d" + std::to_string(depth) + ".exr");
    }
    std::string text(const fs::path& name) const {
        std::ostringstream out;
        out << std::ifstream(folder() / name).rdbuf();
        return out.str();
    }
    std::vector<std::vector<std::string>> csv() const {
        std::vector<std::vector<std::string>> rows;
        std::istringstream lines(text("out/sweep.csv"));
        for (std::string line; std::getline(lines, line);) {
            std::istringstream cells(line + ",");
            rows.emplace_back();
            for (std::string cell; std::getline(cells, cell, ',');)
                rows.back().push_back(cell);
        }
        return rows;
    }
    std::set<fs::path> job_files() const {
        std::set<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder() / "out/jobs"))
            if (entry.path().extension() == ".jsonl")
                files.insert(entry.path());
        return files;
    }
    json results() const { return json::parse(text("out/sweep.json")); }

    const std::string small_ = " --size 32x18 --spp 2 --reference refs --reference-spp 2 --threads 1 -o out ";
    TemporaryFolder folder_;
};

TEST_F(SweepCommand, WritesTablesAndAChart) {
    const Outcome o = run(folder(), "sweep box/scene.xml --vary tile=2,3 --seeds 2 --seed 7" + small_);
    ASSERT_EQ(o.exit_code, 0) << o.output;
    EXPECT_THAT(o.output, HasSubstr("refs/box-32x18-d8.exr is missing: rendering it"));

    const auto rows = csv();
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].size(), 6 + result_columns().size());
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(rows[i].size(), rows[0].size());
    EXPECT_THAT(std::vector(rows[0].begin(), rows[0].begin() + 7),
                ElementsAre("scene", "method", "recon", "tile", "effort", "spp", "seeds"));
    EXPECT_THAT(std::vector(rows[1].begin(), rows[1].begin() + 7),
                ElementsAre("box", "gpr", "weighted", "2", "2 spp", "2", "2"));
    EXPECT_THAT(std::vector(rows[2].begin(), rows[2].begin() + 7),
                ElementsAre("box", "gpr", "weighted", "3", "2 spp", "2", "2"));

    const json all = results();
    EXPECT_EQ(all["version"], "0.2.0");
    EXPECT_EQ(all["machine"]["threads"], 1);
    EXPECT_EQ(all["interrupted"], false);
    ASSERT_EQ(all["results"].size(), 2u);
    const json& row = all["results"][1];
    EXPECT_EQ(row["tile"], 3);
    EXPECT_EQ(row["settings"]["tile"], 3);
    EXPECT_EQ(row["settings"]["max_depth"], 8);
    ASSERT_EQ(row["runs"].size(), 2u);
    EXPECT_EQ(row["runs"][0]["seed"], 7);
    EXPECT_EQ(row["runs"][1]["seed"], 8);
    EXPECT_NEAR(row["relmse"],
                (row["runs"][0]["relmse"].get<double>() + row["runs"][1]["relmse"].get<double>()) / 2, 1e-9);
    EXPECT_NEAR(row["reused_share"].get<double>() + row["skipped_share"].get<double>() +
                    row["dark_share"].get<double>(),
                1, 1e-6);

    EXPECT_THAT(text("out/sweep.md"), HasSubstr("| scene | method | tile 2 | tile 3 |"));
    EXPECT_THAT(text("out/sweep.md"),
                HasSubstr("- box: Reference box-32x18-d8.exr: by G-PR, reconstructed by l2; relMSE of its own"));
    EXPECT_THAT(text("out/sweep.md"),
                HasSubstr("G-PR is also judged here. No picture has a seed of the reference."));
    pugi::xml_document chart;
    EXPECT_TRUE(chart.load_file((folder() / "out/sweep-box.svg").c_str()));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder() / "out"), fs::directory_iterator()), 5)
        << "tables, chart, jobs";
}

TEST_F(SweepCommand, MakesReferencesOnce) {
    const std::string sweep = "sweep box/scene.xml other.xml --vary max_depth=2,3 -m pt" + small_;
    ASSERT_EQ(run(folder(), sweep).exit_code, 0);
    std::vector<std::pair<fs::path, fs::file_time_type>> made;
    for (const char* scene : {"box", "other"})
        for (int depth : {2, 3})
            made.emplace_back(reference(scene, depth), fs::last_write_time(reference(scene, depth)));
    fs::remove(reference("other", 3));
    const Outcome again = run(folder(), sweep);
    EXPECT_EQ(again.exit_code, 0) << again.output;
    EXPECT_THAT(again.output, HasSubstr("other-32x18-d3.exr is missing"));
    for (const auto& [file, time] : made) {
        if (file != reference("other", 3)) {
            EXPECT_EQ(fs::last_write_time(file), time) << file;
        }
    }
    const json settings = json::parse(read_exr(reference("other", 3)).attributes.at("tessera:settings"));
    EXPECT_EQ(settings["seed"], 1001);
    EXPECT_EQ(settings["tile"], 8);
    EXPECT_EQ(settings["max_depth"], 3);
    EXPECT_EQ(csv().size(), 5u);
    for (const char* chart : {"out/sweep-box.svg", "out/sweep-other.svg"})
        EXPECT_TRUE(fs::exists(folder() / chart));
}

TEST_F(SweepCommand, MatchesRenderAndCompare) {
    ASSERT_EQ(run(folder(), "sweep box/scene.xml -m gpr,pr --vary tile=3 --seed 5 --recon l1" + small_).exit_code,
              0);
    const json all = results();
    for (const json& row : all["results"]) {
        const std::string recon = row["method"] == "gpr" ? " --recon l1" : "";
        ASSERT_EQ(run(folder(), "render box/scene.xml -m " + row["method"].get<std::string>() + recon +
                                    " --tile 3 --seed 5 --size 32x18 --spp 2 --max-depth 8 -o image.exr")
                      .exit_code,
                  0);
        const Outcome o = run(folder(), "compare image.exr refs/box-32x18-d8.exr --json");
        const json errors = json::parse(o.output);
        EXPECT_NEAR(row["relmse"], errors["relmse"], 1e-5 * errors["relmse"].get<double>());
        EXPECT_NEAR(row["runs"][0]["relmse_floor_free"], errors["relmse_floor_free"],
                    1e-5 * errors["relmse"].get<double>());
        EXPECT_NEAR(row["relmse_floor_free_uncertainty"], errors["relmse_floor_free_standard_error"],
                    1e-5 * errors["relmse"].get<double>());
    }
}

TEST_F(SweepCommand, TimeLimitEndsARender) {
    const Outcome o = run(folder(), "sweep box/scene.xml -m pt --time 0.1 --size 32x18 --reference refs "
                                    "--reference-spp 2 -o out");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    const json row = results()["results"][0];
    EXPECT_GE(row["cpu_seconds"], 0.1);
    EXPECT_GT(row["spp"], 1);
    EXPECT_EQ(row["relmse_floor_free_deviation"], json()) << "one seed has no deviation";
    EXPECT_EQ(row["skipped_share"], json()) << "PT reuses no paths";
}

TEST_F(SweepCommand, BadInputGetsAMessageAndRendersNothing) {
    folder_.write("file", "");
    fs::create_directories(folder() / "wrong");
    const RgbImage grey(8, 4, Rgb(1));
    write_reference(folder() / "wrong/box-32x18-d8.exr", {grey, {grey, grey}, {1, 2}, ""});
    fs::create_directories(folder() / "plain");
    write_exr(folder() / "plain/box-32x18-d8.exr", {{{"", RgbImage(32, 18, Rgb(1))}}, {}});
    const std::string sweep = "sweep box/scene.xml" + small_;
    const std::vector<std::pair<std::string, std::string>> cases = {
        {sweep + "--vary tiles=2,3", "there is no setting \"tiles\", only: tile,"},
        {sweep + "--vary tile", "must be SETTING=VALUE"},
        {sweep + "--vary tile=", "tile is \"\": must be a whole number from 1 to 16"},
        {sweep + "--vary tile=2,,3", "tile is \"\""},
        {sweep + "--vary tile=2,17", "tile is \"17\": must be a whole number from 1 to 16"},
        {sweep + "--vary tile=2.5", "tile is \"2.5\""},
        {sweep + "--vary rr_delta=-1", "rr_delta is \"-1\": must be a number from 0"},
        {sweep + "--vary roulette=relative,fair", "must be one of relative, absolute, none"},
        {sweep + "--vary adapt_tile=yes", "must be on or off"},
        {sweep + "--vary tile=2 --vary tile=3", "varied twice"},
        {sweep + "--vary tile=2 --vary rr_delta=1 --vary shift=replay", "two settings at the most"},
        {sweep + "-m gpr,bdpt", "-m bdpt"},
        {sweep + "-m ''", "-m"},
        {sweep + "--vary threads=0", "threads is \"0\": must be a whole number from 1 to 1024"},
        {sweep + "--vary size=32", "must be WIDTHxHEIGHT"},
        {sweep + "--vary seed=1,2", "there is no setting \"seed\""},
        {sweep + "--recon l3", "l3"},
        {sweep + "--time 1", "excludes"},
        {sweep + "--seeds 0", "--seeds"},
        {sweep + "--seed 1000 --seeds 2", "seed 1001 is also a seed of refs/box-32x18-d8.exr"},
        {sweep + "--reference-spp 0", "--reference-spp"},
        {sweep + "missing.xml", "missing.xml: there is no such scene file"},
        {sweep + "box", "box: there is no such scene file"},
        {sweep + "box/scene.xml", "are both named \"box\""},
        {sweep + "--size 0x4", "--size 0x4"},
        {sweep + "-o file", "file: the folder cannot be made"},
        {sweep + "-o file/out", "file/out: the folder cannot be made"},
        {sweep + "--reference file", "file: the folder cannot be made"},
        {sweep + "--reference wrong", "wrong/box-32x18-d8.exr is 8x4, but 32x18 is to be rendered"},
        {sweep + "--reference plain", "plain/box-32x18-d8.exr has no layer \"half1\""},
        {"sweep --vary tile=2 --reference refs -o out", "scenes"},
        {"sweep box/scene.xml --reference refs", "--output"},
    };
    for (const auto& [arguments, expected] : cases) {
        const Outcome o = run(folder(), arguments);
        EXPECT_EQ(o.exit_code, 2) << arguments << "\n" << o.output;
        EXPECT_THAT(o.output, HasSubstr(expected)) << arguments;
        EXPECT_THAT(o.output, Not(HasSubstr("rendering"))) << arguments;
        EXPECT_FALSE(fs::exists(folder() / "out/sweep.csv")) << arguments;
        EXPECT_FALSE(fs::exists(reference())) << arguments;
    }
}

TEST_F(SweepCommand, OptionsMayComeBeforeScenes) {
    const Outcome o = run(folder(), "sweep --vary basis=albedo,none -m gpr" + small_ + "box/scene.xml");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    EXPECT_EQ(csv().size(), 3u);
}

TEST_F(SweepCommand, VariesOtherThanRenderSettings) {
    const Outcome o = run(folder(), "sweep box/scene.xml -m gpr,pt --recon l2,l1 --vary size=16x9,32x18 --vary "
                                    "threads=1,2 --spp 2 --reference refs --reference-spp 2 -o out");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    EXPECT_EQ(csv().size(), 1u + 4 * 3);
    EXPECT_TRUE(fs::exists(folder() / "refs/box-16x9-d8.exr"));
    EXPECT_TRUE(fs::exists(reference()));
    ASSERT_EQ(run(folder(), "sweep box/scene.xml --vary alpha=0.1,0.2,0.4" + small_).exit_code, 0);
    EXPECT_EQ(csv().size(), 4u);
}

/// Finished jobs are not rendered again, additional jobs are.
TEST_F(SweepCommand, ReusesFinishedJobs) {
    const std::string sweep = "sweep box/scene.xml --vary tile=2,3" + small_;
    ASSERT_EQ(run(folder(), sweep).exit_code, 0);
    const json first = results()["results"];
    EXPECT_EQ(job_files().size(), 2u);
    ASSERT_EQ(run(folder(), sweep).exit_code, 0);
    EXPECT_EQ(results()["results"], first) << "the times are unchanged";
    EXPECT_EQ(job_files().size(), 2u);
    ASSERT_EQ(run(folder(), sweep + "--seeds 2").exit_code, 0);
    EXPECT_EQ(job_files().size(), 4u);
    EXPECT_EQ(results()["results"][1]["runs"][0], first[1]["runs"][0]);
    ASSERT_EQ(run(folder(), sweep + "--alpha 0.3").exit_code, 0);
    EXPECT_EQ(job_files().size(), 6u) << "other settings make other jobs";
    ASSERT_EQ(run(folder(), "sweep box/scene.xml --vary tile=3 -m pr,gpr" + small_).exit_code, 0);
    EXPECT_EQ(job_files().size(), 7u);
    EXPECT_EQ(results()["results"][1]["runs"], first[1]["runs"]) << "a job of two methods reuses the finished one";
    fs::remove_all(folder() / "out");
    ASSERT_EQ(run(folder(), sweep).exit_code, 0);
    const std::string mine = "\"program\":\"0.2.0 ", other = "\"program\":\"0.0.9 ";
    for (const fs::path& file : job_files()) { // as another build would write it
        std::string lines = text(file);
        lines.replace(lines.find(mine), mine.size(), other);
        fs::remove(file);
        folder_.write("out/jobs/other-" + file.filename().string(), lines);
    }
    ASSERT_EQ(run(folder(), sweep + "--any-build").exit_code, 0);
    EXPECT_EQ(job_files().size(), 2u);
    ASSERT_EQ(run(folder(), sweep).exit_code, 0);
    EXPECT_EQ(job_files().size(), 4u) << "another build may be faster";
    fs::remove(reference());
    ASSERT_EQ(run(folder(), sweep + "--reference-spp 4").exit_code, 0);
    EXPECT_EQ(job_files().size(), 6u) << "another reference gives other errors";
}

TEST_F(SweepCommand, InterruptKeepsFinishedJobs) {
    const pid_t child = fork();
    if (child == 0) {
        if (chdir(folder().c_str()) != 0 || !std::freopen("log.txt", "w", stderr))
            _exit(100);
        execl(TESSERA_BINARY, "tessera", "sweep", "box/scene.xml", "--vary", "tile=2,3", "--seeds", "1000",
              "--size", "32x18", "--spp", "8", "--reference", "refs", "--reference-spp", "2", "-o", "out",
              static_cast<char*>(nullptr));
        _exit(101);
    }
    EXPECT_TRUE(eventually([&] { return fs::exists(folder() / "out/sweep-box.svg"); }));
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1) << "the sweep is incomplete";
    const json all = results();
    EXPECT_EQ(all["interrupted"], true);
    ASSERT_GE(all["results"].size(), 1u);
    EXPECT_GE(all["results"][0]["runs"].size(), 1u);
    EXPECT_LT(all["results"][0]["runs"].size(), 1000u);
    EXPECT_EQ(csv().size(), 1 + all["results"].size());
}

} // namespace

} // namespace tessera::test
