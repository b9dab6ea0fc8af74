// `tessera reference`: the file and its error. Neither a kill nor Ctrl-C changes a bit of the file.
#include "render/io/exr.h"
#include "render/run/reference_image.h"
#include "tests/app/program.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/eventually.h"

#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string box = std::string(TESSERA_SOURCE_DIR) + "/assets/cornell-box.xml";

class ReferenceCommand : public testing::Test {
protected:
    const fs::path& folder() const { return folder_.path(); }
    Outcome reference(const std::string& arguments) const {
        return run(folder(), "reference " + box + " --size 24x16 --max-depth 4 --threads 1 " + arguments);
    }
    /// Starts a long reference, waits for a checkpoint, sends the signal and returns the exit status.
    int end_early(int signal) const {
        const pid_t child = fork();
        if (child == 0) {
            if (chdir(folder().c_str()) != 0 || !std::freopen("log.txt", "w", stderr))
                _exit(100);
            execl(TESSERA_BINARY, "tessera", "reference", box.c_str(), "--size", "24x16", "--max-depth", "4",
                  "--threads", "1", "--spp", "100000", "--checkpoint", "0", "-o", "a.exr",
                  static_cast<char*>(nullptr));
            _exit(101);
        }
        EXPECT_TRUE(eventually([&] { return fs::exists(checkpoint_); }));
        std::this_thread::sleep_for(
            std::chrono::milliseconds(200)); // so that some passes follow the first checkpoint
        kill(child, signal);
        int status = 0;
        waitpid(child, &status, 0);
        return status;
    }
    /// Returns the samples per pixel of the checkpoint, from the program's message.
    int spp_of_checkpoint() const {
        const std::string text = reference("--spp 2 -o a.exr").output, words = "checkpoint has ";
        return std::stoi(text.substr(text.find(words) + words.size()));
    }
    std::string bytes(const fs::path& name) const {
        std::ostringstream out;
        out << std::ifstream(folder() / name, std::ios::binary).rdbuf();
        return out.str();
    }

    TemporaryFolder folder_;
    fs::path checkpoint_ = folder_.path() / "a.exr.checkpoint";
};

TEST_F(ReferenceCommand, HasTwoHalvesAndTheirMean) {
    const Outcome o = reference("-m pt --spp 7 --seed 5 -o a.exr");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    const ReferenceImage r = read_reference(folder() / "a.exr");
    EXPECT_EQ(r.seeds, (std::array<std::uint64_t, 2>{5, 6}));
    EXPECT_EQ(nlohmann::json::parse(r.settings)["spp"], 8) << "four samples per half";
    ASSERT_EQ(run(folder(),
                  "render " + box + " -m pt --size 24x16 --max-depth 4 --threads 1 --spp 4 --seed 6 -o half.exr")
                  .exit_code,
              0);
    const ExrFile half = read_exr(folder() / "half.exr");
    EXPECT_EQ(
        std::memcmp(half.layers[0].image.data(), r.halves[1].data(), half.layers[0].image.size() * sizeof(Rgb)),
        0);
    const FloorFreeError error = error_of(r);
    EXPECT_GT(error.relative_mse, 0);
    const auto about = nlohmann::json::parse(read_exr(folder() / "a.exr").attributes.at("tessera:reference"));
    EXPECT_NEAR(about["relmse"], error.relative_mse, 1e-12);
    EXPECT_EQ(about["made_by"], "pt");
    EXPECT_THAT(o.output, HasSubstr("a.exr: by pt; relMSE of the reference itself"));
    EXPECT_FALSE(fs::exists(checkpoint_));
}

TEST_F(ReferenceCommand, StatesHowItWasMade) {
    EXPECT_THAT(reference("--spp 2 -o a.exr").output, HasSubstr("a.exr: by gpr, reconstructed by l2;"));
    EXPECT_THAT(reference("-m gpt --recon none --spp 2 -o b.exr").output,
                HasSubstr("b.exr: by gpt, reconstructed by none;"));
    EXPECT_EQ(origin_of(read_reference(folder() / "b.exr")), (ReferenceOrigin{Method::gpt, "none"}));
}

TEST_F(ReferenceCommand, IdentifiesItsSceneByContents) {
    const auto scene = [&](const std::string& arguments) {
        const Outcome o = run(folder(), "reference " + arguments + " --size 24x16 --max-depth 3 --spp 2 -o a.exr");
        EXPECT_EQ(o.exit_code, 0) << o.output;
        return read_exr(folder() / "a.exr").attributes["tessera:scene"];
    };
    std::ostringstream xml;
    xml << std::ifstream(box).rdbuf();
    const std::string known = scene(box + " --threads 1");
    EXPECT_EQ(known.rfind("geometry ", 0), 0u) << known;
    folder_.write("elsewhere/mine.xml", xml.str() + "<!-- a remark -->\n");
    EXPECT_EQ(scene("elsewhere/mine.xml --threads 2 -m pt --seed 7"), known);
    EXPECT_NE(scene("elsewhere/mine.xml -D alpha=0.13"), known);
    folder_.write("camera.json", R"({"to_world": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], "fov": 40})");
    const std::string other = scene("elsewhere/mine.xml --camera camera.json");
    EXPECT_EQ(other.substr(0, other.find("camera")), known.substr(0, known.find("camera")));
    EXPECT_NE(other, known);
}

/// The error estimated from the halves matches the error to a far better reference.
TEST_F(ReferenceCommand, KnowsItsError) {
    ASSERT_EQ(reference("-m pt --spp 32 -o a.exr").exit_code, 0);
    ASSERT_EQ(reference("-m gpr --spp 1024 --seed 1 -o b.exr").exit_code, 0);
    const ReferenceImage a = read_reference(folder() / "a.exr"), b = read_reference(folder() / "b.exr");
    const FloorFreeError known = error_of(a);
    const FloorFreeError measured = measure_floor_free_error(a.mean, b.halves[0], b.halves[1]);
    EXPECT_NEAR(known.relative_mse, measured.relative_mse, 4 * (known.standard_error + measured.standard_error));
    EXPECT_LT(known.standard_error, 0.5 * known.relative_mse);
}

TEST_F(ReferenceCommand, ResumesAfterAKillWithTheSameBits) {
    EXPECT_TRUE(WIFSIGNALED(end_early(SIGKILL)));
    ASSERT_TRUE(fs::exists(checkpoint_));
    EXPECT_FALSE(fs::exists(folder() / "a.exr"));
    const std::string spp = std::to_string(spp_of_checkpoint() + 6);
    const Outcome o = reference("--spp " + spp + " -o a.exr");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    EXPECT_THAT(o.output, HasSubstr("going on from"));
    EXPECT_FALSE(fs::exists(checkpoint_));
    ASSERT_EQ(reference("--spp " + spp + " -o whole.exr").exit_code, 0);
    EXPECT_EQ(bytes("a.exr"), bytes("whole.exr"));
}

TEST_F(ReferenceCommand, CanResumeAfterCtrlC) {
    const int status = end_early(SIGINT);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1) << "the reference is incomplete";
    EXPECT_THAT(bytes("log.txt"), HasSubstr("a.exr: not complete; run the same command again"));
    EXPECT_TRUE(fs::exists(checkpoint_));
}

TEST_F(ReferenceCommand, RejectsTheCheckpointOfAnotherReference) {
    end_early(SIGKILL);
    const std::string checkpoint = bytes("a.exr.checkpoint");
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"--tile 5", "checkpoint is of tile 8, not 5"},
        {"-m pt", "checkpoint is of method \"gpr\", not \"pt\""},
        {"--size 24x18", "checkpoint is of height 16, not 18"},
        {"--seed 7", "checkpoint is of seed 1001, not 7"},
        {"--camera camera.json", "checkpoint is of another camera"},
        {"--spp 2", "spp already, and 2 are asked for"},
    };
    folder_.write("camera.json", R"({"to_world": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], "fov": 40})");
    for (const auto& [arguments, expected] : cases) {
        const Outcome o = reference("--spp 100000 -o a.exr " + arguments);
        EXPECT_EQ(o.exit_code, 2) << arguments << o.output;
        EXPECT_THAT(o.output, HasSubstr(expected)) << arguments;
    }
    folder_.write("a.exr.checkpoint", checkpoint.substr(0, checkpoint.size() - 1));
    EXPECT_THAT(reference("--spp 100000 -o a.exr").output, HasSubstr("a.exr.checkpoint: is damaged"));
    folder_.write("a.exr.checkpoint", "");
    EXPECT_THAT(reference("--spp 100000 -o a.exr").output, HasSubstr("a.exr.checkpoint: is not a checkpoint"));
}

/// Shards are merged one by one, so the memory does not depend on their number.
TEST_F(ReferenceCommand, MergesAnyNumberOfShardsInTheMemoryForTwo) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers keep freed memory";
#endif
    const auto peak_of = [&](int count) {
        std::string files;
        for (int number = 1; number <= count; ++number) {
            const std::string file = std::to_string(number) + "-of-" + std::to_string(count) + ".share";
            const Outcome o = reference("--size 192x108 --spp " + std::to_string(2 * count) + " --share " +
                                        std::to_string(number) + "/" + std::to_string(count) + " -o " + file);
            EXPECT_EQ(o.exit_code, 0) << o.output;
            files += file + " ";
        }
        return peak_memory(folder(), "merge " + files + "-o ref.exr");
    };
    const std::size_t of_two = peak_of(2), of_twelve = peak_of(12);
    const std::size_t shard_bytes = fs::file_size(folder() / "1-of-12.share");
    ASSERT_GT(of_two, 2 * shard_bytes); // large enough to show if all shards were in memory
    EXPECT_LT(of_twelve, of_two + shard_bytes);
}

TEST_F(ReferenceCommand, BadInputGetsAMessage) {
    EXPECT_THAT(reference("-o a.png").output, HasSubstr("a.png: the name must end in .exr"));
    EXPECT_THAT(reference("-o none/a.exr").output, HasSubstr("none/a.exr: cannot be written"));
    EXPECT_EQ(reference("--recon l3 -o a.exr").exit_code, 2);
    EXPECT_EQ(reference("--recon l2,none -o a.exr").exit_code, 2); // a reference has one reconstruction
    EXPECT_EQ(reference("--spp 1 -o a.exr").exit_code, 2);
}

} // namespace

} // namespace tessera::test
