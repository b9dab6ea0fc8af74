// `tessera bench`: its files, and resuming after a kill without rendering finished runs again.
#include "render/io/exr.h"
#include "render/run/reference_image.h"
#include "tests/app/program.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/eventually.h"

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <system_error>

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
using testing::HasSubstr;
using testing::Not;

class BenchCommand : public testing::Test {
protected:
    void SetUp() override {
        fs::copy_file(fs::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml", folder() / "box.xml");
    }
    const fs::path& folder() const { return folder_.path(); }
    std::string text(const fs::path& name) const {
        std::ostringstream out;
        out << std::ifstream(folder() / name, std::ios::binary).rdbuf();
        return out.str();
    }
    std::ptrdiff_t lines(const fs::path& name) const {
        const std::string all = text(name);
        return std::count(all.begin(), all.end(), '\n');
    }

    /// Returns the contents of the finished jobs' files, by file name.
    std::map<std::string, std::string> finished_jobs() const {
        std::map<std::string, std::string> jobs;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(folder() / "out/jobs", none))
            if (entry.path().extension() == ".jsonl")
                jobs[entry.path().filename()] = text("out/jobs" / entry.path().filename());
        return jobs;
    }

    const std::string small_ =
        " --size 32x18 --spp 8 --halvings 2 --reference refs --reference-spp 64 --threads 1 -o out ";
    TemporaryFolder folder_;
};

TEST_F(BenchCommand, WritesAPageWithCharts) {
    const Outcome o = run(folder(), "bench box.xml --methods pt,gpr --recon l2,l1 --seeds 2" + small_);
    ASSERT_EQ(o.exit_code, 0) << o.output;
    EXPECT_EQ(lines("out/bench.csv"), 1 + 3 * 3) << "three curves of three measurements";
    EXPECT_THAT(text("out/bench.csv"), HasSubstr("\nbox,pt,none,2 spp,2,2,"));
    EXPECT_THAT(text("out/bench.csv"), HasSubstr("\nbox,gpr,l1,8 spp,8,2,"));
    EXPECT_EQ(lines("out/bench-speedup.csv"), 1 + 2);
    const json all = json::parse(text("out/bench.json"));
    EXPECT_EQ(all["results"].size(), 9u);
    EXPECT_EQ(all["results"][0]["runs"].size(), 2u);
    pugi::xml_document chart;
    EXPECT_TRUE(chart.load_file((folder() / "out/bench-box.svg").c_str()));
    ASSERT_TRUE(chart.load_file((folder() / "out/bench-box-seen.svg").c_str()));
    const std::string seen = text("out/bench-box-seen.svg");
    for (const char* part : {">PSNR, dB<", ">FLIP<", ">pt<", ">gpr l2<", ">gpr l1<"})
        EXPECT_THAT(seen, HasSubstr(part));
    const std::size_t points = chart.select_nodes("//circle").size();
    EXPECT_GE(points, 2u * 3 * 3) << "two plots of three curves of three measurements";

    const std::string page = text("out/bench.html");
    for (const char* part : {"<svg xmlns", "data:image/png;base64,", "PT over G-PR", "gpr l1", "max_depth",
                             "<th>FLIP</th>", "PSNR, dB", "seed 0", "</html>",
                             "Reference box-32x18-d8.exr: by G-PR, reconstructed by l2; relMSE of its own",
                             "G-PR is also judged here. No picture has a seed of the reference."})
        EXPECT_THAT(page, HasSubstr(part));
    for (const char* part : {"<option value=\"0\" selected>reference</option>", "alt=\"gpr l1\"", "<canvas>",
                             "value=\"flicker\"", "querySelectorAll('.compare')"})
        EXPECT_THAT(page, HasSubstr(part));
    for (const char* part : {"src=\"http", "href=", "<script src", "src=\"out"})
        EXPECT_THAT(page, Not(HasSubstr(part))) << "the page needs no other file";

    fs::resize_file(folder() / "out/images/box-pt.exr", 200);
    const Outcome again = run(folder(), "bench box.xml --methods pt,gpr --recon l2,l1 --seeds 2" + small_);
    EXPECT_EQ(again.exit_code, 0);
    EXPECT_THAT(again.output, HasSubstr("box-pt.exr"));
    EXPECT_THAT(text("out/bench.html"), HasSubstr("alt=\"gpr l1\"")) << "the page shows the other pictures";
}

/// With a limit of samples, the page states nothing about equal time. With a limit of time, it compares the error
/// of the reference's method at equal time.
TEST_F(BenchCommand, StatesTheMethodOfReferences) {
    ASSERT_EQ(
        run(folder(), "bench box.xml -m pt,gpr --recon l2 --seeds 2 --reference-method pt" + small_).exit_code, 0);
    EXPECT_THAT(text("out/bench.html"), HasSubstr("Reference box-32x18-d8.exr: by PT; relMSE of its own"));
    EXPECT_THAT(text("out/bench.html"), Not(HasSubstr("is also judged here")));
    const Outcome o =
        run(folder(), "bench box.xml -m pt,gpr --recon l2 --seeds 2 --size 32x18 --time 0.05 --halvings 0 "
                      "--reference gpr --reference-spp 1024 --threads 1 -o timed");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    EXPECT_THAT(text("timed/bench.html"), HasSubstr("G-PR is also judged here; "));
    EXPECT_THAT(text("timed/bench.html"), HasSubstr("at equal time its error is "));
}

TEST_F(BenchCommand, QuickReducesTheDefaults) {
    const Outcome o = run(folder(), "bench box.xml --quick -m pt,gpr --size 32x18 --spp 4 --reference refs "
                                    "--reference-spp 16 --threads 1 -o out");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    EXPECT_EQ(lines("out/bench.csv"), 1 + 2 * 3) << "one norm, and all halvings of 4 samples";
    EXPECT_THAT(text("out/bench.csv"), HasSubstr("\nbox,gpr,weighted,4 spp,4,2,"));
}

TEST_F(BenchCommand, MeasuresCpuAndWallTime) {
    ASSERT_EQ(run(folder(),
                  "bench box.xml --methods pt --seeds 1 --time 0.2 --halvings 1 --size 32x18 --reference "
                  "refs --reference-spp 16 --threads 1 -o out")
                  .exit_code,
              0);
    const json results = json::parse(text("out/bench.json"))["results"];
    ASSERT_EQ(results.size(), 2u);
    EXPECT_EQ(results[0]["effort"], "0.1 CPU s");
    EXPECT_GE(results[0]["cpu_seconds"], 0.1);
    EXPECT_LT(results[0]["cpu_seconds"], results[1]["cpu_seconds"]);
    EXPECT_GE(results[1]["cpu_seconds"], 0.2);
    EXPECT_GT(results[1]["wall_seconds"], 0);
}

TEST_F(BenchCommand, ResumesAfterAKill) {
    const pid_t child = fork();
    if (child == 0) {
        if (chdir(folder().c_str()) != 0 || !std::freopen("log.txt", "w", stderr))
            _exit(100);
        execl(TESSERA_BINARY, "tessera", "bench", "box.xml", "--methods", "pt,gpr", "--recon", "l2,l1", "--size",
              "32x18", "--spp", "8", "--halvings", "2", "--reference", "refs", "--reference-spp", "64",
              "--threads", "1", "--seeds", "900", "-o", "out", static_cast<char*>(nullptr));
        _exit(101);
    }
    EXPECT_TRUE(eventually([&] { return finished_jobs().size() >= 2; }));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const std::map<std::string, std::string> before = finished_jobs();
    ASSERT_GE(before.size(), 2u);
    EXPECT_FALSE(fs::exists(folder() / "out/bench.html") &&
                 text("out/bench.html").find("</html>") == std::string::npos);

    const Outcome o = run(folder(), "bench box.xml --methods pt,gpr --recon l2,l1 --seeds 2" + small_);
    ASSERT_EQ(o.exit_code, 0) << o.output;
    EXPECT_EQ(finished_jobs(), before) << "nothing is rendered again";
    EXPECT_EQ(json::parse(text("out/bench.json"))["results"][0]["runs"].size(), 2u);
    fs::remove(folder() / "out/images/box-pt.exr");
    ASSERT_EQ(run(folder(), "bench box.xml --methods pt,gpr --recon l2,l1 --seeds 2" + small_).exit_code, 0);
    EXPECT_TRUE(fs::exists(folder() / "out/images/box-pt.exr"));
}

TEST_F(BenchCommand, ReferencesHaveADefaultFolder) {
    for (const char* command : {"bench", "sweep"}) {
        const Outcome o = run(folder(), std::string(command) +
                                            " box.xml --methods pt --seeds 1 --size 32x18 --spp 4 "
                                            "--reference-spp 16 --threads 1 -o " +
                                            command);
        EXPECT_EQ(o.exit_code, 0) << o.output;
        EXPECT_TRUE(fs::exists(folder() / "references/box-32x18-d8.exr")) << o.output;
    }
}

TEST_F(BenchCommand, RejectsTheReferenceOfAnotherScene) {
    const std::string bench = "bench box.xml --methods pt --seeds 1" + small_;
    ASSERT_EQ(run(folder(), bench).exit_code, 0);
    ASSERT_EQ(run(folder(), "reference box.xml -m pt --spp 4 --size 32x18 --max-depth 8 -o refs/pt.exr").exit_code,
              0);
    std::string box = text("box.xml");
    folder_.write("box.xml", box + "<!-- a remark -->\n");
    const Outcome same = run(folder(), bench);
    EXPECT_EQ(same.exit_code, 0) << same.output;
    EXPECT_THAT(same.output, Not(HasSubstr("refs/"))) << "an equal scene gives no message";

    const std::string red = "0.60, 0.06, 0.05";
    folder_.write("box.xml", box.replace(box.find(red), red.size(), "0.60, 0.06, 0.06"));
    for (const std::string& command :
         {bench,
          "sweep box.xml --vary tile=2,3" + small_.substr(0, small_.find(" --halvings")) +
              " --reference refs --threads 1 -o out",
          std::string("stability box.xml --size 32x18 --spp 8 --seeds 2 --reference refs --threads 1 -o out")}) {
        if (command.rfind("stability", 0) == 0) // stability accepts only references by PT
            fs::rename(folder() / "refs/pt.exr", folder() / "refs/box-32x18-d8.exr");
        const Outcome other = run(folder(), command);
        EXPECT_EQ(other.exit_code, 2) << other.output;
        EXPECT_THAT(other.output, HasSubstr("refs/box-32x18-d8.exr does not match box.xml: different materials. "
                                            "Delete the file"))
            << command;
    }
    fs::remove(folder() / "refs/box-32x18-d8.exr");
    EXPECT_EQ(run(folder(), bench).exit_code, 0);
}

TEST_F(BenchCommand, ReportsErrorsBelowTheirUncertaintyAsBounds) {
    // The reference halves lie on both sides of the rendered picture.
    ASSERT_EQ(
        run(folder(), "render box.xml -m gpr --size 32x18 --max-depth 8 --spp 4 --recon l2 -o box.exr").exit_code,
        0);
    const RgbImage picture = read_exr(folder() / "box.exr").layers[0].image;
    RgbImage low = picture, high = picture;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        low.data()[i] *= 0.9f;
        high.data()[i] *= 1.1f;
    }
    fs::create_directories(folder() / "refs");
    write_reference(folder() / "refs/box-32x18-d8.exr", {picture, {low, high}, {77, 78}, ""});
    const Outcome o = run(folder(), "bench box.xml --methods gpr --recon l2 --seeds 1 --size 32x18 --spp 4 "
                                    "--halvings 0 --reference refs -o out");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    EXPECT_THAT(o.output, HasSubstr("note: refs/box-32x18-d8.exr does not say which scene it is of"));
    const json row = json::parse(text("out/bench.json"))["results"][0];
    EXPECT_EQ(row["below_uncertainty"], 1);
    EXPECT_EQ(row["relmse_floor_free"], json());
    EXPECT_GT(row["relmse_floor_free_uncertainty"], 0);
    EXPECT_THAT(text("out/bench.html"), HasSubstr("<td>&lt; "));
}

} // namespace

} // namespace tessera::test
