// The program's command line. Bad input gives one message and exit code 2, and leaves no file.
#include "render/io/exr.h"
#include "render/load/mitsuba_xml.h"
#include "render/scene/camera.h"
#include "tests/app/program.h"
#include "tests/support/eventually.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;

class CommandLine : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("tessera-cli-" + std::to_string(getpid()));
        fs::create_directories(folder_);
        fs::copy_file(fs::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml", box_,
                      fs::copy_options::overwrite_existing);
    }
    void TearDown() override { fs::remove_all(folder_); }

    void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

    fs::path folder_ = fs::temp_directory_path() / ("tessera-cli-" + std::to_string(getpid()));
    fs::path box_ = folder_ / "box.xml";
};

TEST_F(CommandLine, HelpOfScriptsSeparatesColumns) {
    const std::string help = run(folder_, "view --help").output;
    EXPECT_THAT(help, testing::HasSubstr("wait scene | spp N | seconds S | reference waits for the scene"));
}

TEST_F(CommandLine, HelpGroupsOptionsWithEverydayOnesFirst) {
    for (const char* command : {"bench", "stability", "sweep", "render", "view", "reference"}) {
        const std::string help = run(folder_, std::string(command) + " --help").output;
        const std::size_t everyday = help.find("\nEveryday:\n"), published = help.find("\nPublished settings:\n"),
                          tile = help.find("\n  --tile "), roulette = help.find("\n  --roulette ");
        EXPECT_LT(everyday, help.find("\n  -m,--method")) << command;
        EXPECT_LT(help.find("\n  -m,--method"), published) << command;
        EXPECT_LT(published, tile) << command;
        EXPECT_LT(tile, roulette) << command;
        EXPECT_NE(roulette, std::string::npos) << command;
        EXPECT_LT(help.find("\nExpert:\n"), help.find("\n  --threads ")) << command;
        EXPECT_NE(help.find("\n  --threads "), std::string::npos) << command;
    }
    EXPECT_THAT(run(folder_, "compare --help").output, testing::HasSubstr("\nOptions:\n"))
        << "few options need no groups";
}

TEST_F(CommandLine, RenderHasFewOptionsAllInGroups) {
    const std::string help = run(folder_, "render --help").output;
    EXPECT_THAT(help, testing::Not(testing::HasSubstr("Other options")));
    std::istringstream lines(help);
    int options = 0;
    for (std::string line; std::getline(lines, line);)
        options += line.starts_with("  -");
    EXPECT_LE(options, 33); // including --help
}

TEST_F(CommandLine, ASceneAloneOpensTheViewer) {
    const Outcome help = run(folder_, "box.xml --help");
    EXPECT_EQ(help.exit_code, 0) << help.output;
    EXPECT_NE(help.output.find("explore a scene in a window"), std::string::npos) << help.output;
    const Outcome missing = run(folder_, "missing.xml");
    EXPECT_EQ(missing.exit_code, 2);
    EXPECT_NE(missing.output.find("missing.xml"), std::string::npos) << missing.output;
}

TEST_F(CommandLine, BadInputGetsAMessageAndExitCode2) {
    write("broken.xml", "<scene version=\"3.0.0\">\n  <shape type=\"cube\">\n</scene>\n");
    write("bad-mesh.xml",
          "<scene version=\"3.0.0\"><shape type=\"obj\"><string name=\"filename\" value=\"bad.obj\"/>"
          "</shape></scene>");
    write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    const std::string render = "render box.xml --size 16x16 --spp 1 -o out.exr ";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"render missing.xml -o out.exr", "missing.xml"},
        {"render broken.xml -o out.exr", "broken.xml:3"},
        {"render bad-mesh.xml --strict -o out.exr", "bad.obj"},
        {render + "--size 0x0", "--size 0x0"},
        {render + "--size 640", "--size 640"},
        {render + "--size 32768x32768", "--size 32768x32768: an image of 32768 by 32768 pixels is too large"},
        {render + "--size 16x16x16", "--size 16x16x16"},
        {render + "--spp -3", "--spp"},
        {render + "--spp 0", "--spp"},
        {render + "--time nan", "--time: \"nan\" must be a number from 0.001"},
        {render + "--time inf", "--time"},
        {render + "--rr-delta nan", "--rr-delta"},
        {render + "--seed 18446744073709551616", "--seed"},
        {render + "--seed -1", "--seed"},
        {render + "--stats out.exr", "out.exr: -o and --stats are the same file"},
        {"render box.xml --size 16x16 --spp 1 -o ./box.xml", "box.xml: -o and the scene are the same file"},
        {"render '' --size 16x16 --spp 1 -o out.exr", "the name is empty"},
        {"render /dev/zero --size 16x16 --spp 1 -o out.exr", "/dev/zero: this is a device or a pipe, not a file"},
        {"reference box.xml --checkpoint nan -o out.exr", "--checkpoint"},
        {"sweep box.xml --seeds nan --reference refs -o out", "--seeds"},
        {"view --seconds nan", "--seconds"},
        {render + "--time -1", "--time"},
        {"view box.xml --window 0x5", "--window 0x5"},
        {"render box.xml --spp 1 --size 16x16 --seed -1 -o out.exr", "--seed"},
        {render + "-m bdpt", "bdpt"},
        {render + "--tile 0", "--tile"},
        {render + "--tile 17", "--tile"},
        {render + "--rr-delta -1", "--rr-delta"},
        {render + "--rr-delta -1", "--rr-delta"},
        {render + "--max-depth 0", "--max-depth"},
        {render + "--recon l3", "l3"},
        {render + "-D novalue", "novalue"},
        {render + "--threads -1", "--threads"},
        {render + "--nonsense", "nonsense"},
        {"render box.xml --spp 1 --size 16x16 -o no/such/folder/out.exr", "no/such/folder"},
        {"render box.xml --spp 1 --size 16x16 -o .", "folder"},
        {"render box.xml --spp 1 --size 16x16 -o out.exr --stats no/such/stats.json", "no/such"},
        {"render box.xml --spp 1 --size 16x16 -o out.tiff", "must end in .exr or .png"},
        {"render box.xml --spp 1 --size 16x16 -o out.png --buffers", "holds one picture"},
        {"compare missing.exr missing.exr", "missing.exr"},
        {"compare box.xml box.xml", "box.xml"},
        {"info missing.xml", "missing.xml"},
        {"info broken.xml", "broken.xml:3"},
        {"", "no command"},
        {"paint", "paint"},
    };
    for (const auto& [arguments, expected] : cases) {
        const Outcome o = run(folder_, arguments);
        EXPECT_EQ(o.exit_code, 2) << arguments << "\n" << o.output;
        EXPECT_NE(o.output.find(expected), std::string::npos) << arguments << "\n" << o.output;
        EXPECT_FALSE(fs::exists(folder_ / "out.exr")) << arguments;
    }
    for (const auto& entry : fs::directory_iterator(folder_))
        EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
}

TEST_F(CommandLine, AcceptsNamesThatAreNotUtf8) {
    fs::copy_file(folder_ / "box.xml", folder_ / "sc\xe8ne.xml");
    const std::string size = " --size 24x16 --max-depth 3 ";
    for (const std::string& command :
         {"render sc\xe8ne.xml --spp 1 -o out.exr --stats out.json" + size,
          "reference sc\xe8ne.xml --spp 2 --checkpoint 0 -o ref.exr" + size,
          "bench sc\xe8ne.xml --spp 2 --methods pt --seeds 1 --reference refs --reference-spp 2 -o out" + size}) {
        const Outcome o = run(folder_, command);
        EXPECT_EQ(o.exit_code, 0) << command << "\n" << o.output;
    }
    std::ifstream stats(folder_ / "out.json");
    EXPECT_EQ(nlohmann::json::parse(stats)["settings"]["scene"], "sc\xef\xbf\xbdne.xml");
}

TEST_F(CommandLine, RefusesWhatExceedsMemoryWithSizes) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers take all address space";
#endif
    const auto limited = [&](const std::string& arguments) {
        return run(folder_,
                   "--version >/dev/null; ulimit -v 2000000; '" + std::string(TESSERA_BINARY) + "' " + arguments);
    };
    const Outcome film = limited("render box.xml --size 8192x8192 --spp 1 -o out.exr");
    EXPECT_EQ(film.exit_code, 1);
    EXPECT_NE(film.output.find("8192x8192 pixels of gpr need "), std::string::npos) << film.output;
    EXPECT_NE(film.output.find(" GiB of memory, and "), std::string::npos) << film.output;
    const Outcome threads = limited("render box.xml --size 16x16 --spp 1 --threads 1024 -o out.exr");
    EXPECT_EQ(threads.exit_code, 2) << "no abort: " << threads.output;
    EXPECT_NE(threads.output.find("of the 1024 asked for"), std::string::npos) << threads.output;
    EXPECT_FALSE(fs::exists(folder_ / "out.exr"));
}

TEST_F(CommandLine, KeepsThePictureIfTheDiskIsFull) {
    if (!fs::exists("/dev/full"))
        GTEST_SKIP() << "there is no /dev/full";
    fs::create_symlink("/dev/full", folder_ / "full.png"); // rejects all writes
    const Outcome o = run(folder_, "render box.xml --size 16x16 --spp 1 -o full.png");
    EXPECT_NE(o.exit_code, 0);
    const std::string mark = "the picture is kept as ";
    const std::size_t at = o.output.find(mark);
    ASSERT_NE(at, std::string::npos) << o.output;
    const fs::path kept = o.output.substr(at + mark.size(), o.output.find('\n', at) - at - mark.size());
    EXPECT_GT(fs::file_size(kept), 100u);
    fs::remove(kept);
    EXPECT_TRUE(fs::is_symlink(folder_ / "full.png"));
}

TEST_F(CommandLine, ClampsExcessiveRadiance) {
    write("bright.xml", "<scene version='3.0.0'><shape type='cube'/><emitter type='constant'><rgb name='radiance' "
                        "value='3e38'/></emitter></scene>");
    const Outcome o =
        run(folder_, "render bright.xml --size 32x18 --spp 2 --recon l2,l1,mixed,weighted -o out.exr");
    EXPECT_EQ(o.exit_code, 0) << o.output;
    EXPECT_NE(o.output.find("'radiance' is clamped to 1e15"), std::string::npos) << o.output;
    for (const ExrLayer& layer : read_exr(folder_ / "out.exr").layers)
        for (const Rgb& pixel : layer.image)
            ASSERT_TRUE(std::isfinite(pixel.r + pixel.g + pixel.b)) << layer.name;
}

TEST_F(CommandLine, WritesAPngForANameInPng) {
    const Outcome o = run(folder_, "render box.xml --size 24x16 --spp 1 -o out.PNG");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    std::ifstream file(folder_ / "out.PNG", std::ios::binary);
    char signature[4] = {};
    file.read(signature, 4);
    EXPECT_EQ(std::string(signature + 1, 3), "PNG");
}

TEST_F(CommandLine, RendersLayersSettingsAndStats) {
    const Outcome o = run(folder_, "render box.xml -m gpr --size 24x16 --spp 3 --tile 4 --seed 9 --max-depth 4 "
                                   "--recon l2,l1,none --buffers -o out.exr --stats out.json");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    const ExrFile file = read_exr(folder_ / "out.exr");
    std::vector<std::string> names;
    for (const ExrLayer& layer : file.layers) {
        names.push_back(layer.name);
        EXPECT_EQ(layer.image.width(), 24);
        EXPECT_EQ(layer.image.height(), 16);
    }
    for (const char* name :
         {"", "l1", "none", "primal", "primal_without_direct", "coefficient", "coefficient_dx", "coefficient_dy",
          "direct", "mean_albedo", "reused", "failed", "survival", "reuse_set_size", "gain", "samples"})
        EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;

    const auto settings = nlohmann::json::parse(file.attributes.at("tessera:settings"));
    EXPECT_EQ(settings["method"], "gpr");
    EXPECT_EQ(settings["tile"], 4);
    EXPECT_EQ(settings["seed"], 9);
    EXPECT_EQ(settings["spp"], 3);

    const auto stats = nlohmann::json::parse(std::ifstream(folder_ / "out.json"));
    EXPECT_GE(stats["camera_paths"], 24 * 16 * 3);
    for (const char* kind : {"camera", "bounce", "light", "shift_edge"})
        EXPECT_GT(stats["rays"][kind], 0) << kind;
    EXPECT_GT(stats["shifts"]["attempts"], 0);
    EXPECT_GT(stats["peak_memory"], 0);
    for (const char* phase : {"load", "bvh", "render"})
        for (const char* clock : {"wall", "cpu"})
            EXPECT_TRUE(stats["seconds"][phase][clock].is_number()) << phase << ' ' << clock;
}

TEST_F(CommandLine, BuffersHoldShiftOutcomes) {
    ASSERT_EQ(run(folder_, "render box.xml -m pr --size 24x16 --spp 4 --buffers -o out.exr").exit_code, 0);
    const ExrFile file = read_exr(folder_ / "out.exr");
    const auto value = [&](const std::string& layer, std::size_t i) {
        const RgbImage* image = find_layer(file, layer);
        return image ? image->data()[i].r : std::numeric_limits<float>::quiet_NaN();
    };
    for (std::size_t i = 0; i < 24 * 16; ++i) {
        float failed = 0;
        for (const char* outcome : {"occluded", "kind_mismatch", "total_reflection", "outside", "no_light"})
            failed += value(std::string("shifts_") + outcome, i);
        EXPECT_NEAR(failed, value("failed", i), 1e-6f);
        EXPECT_NEAR(failed + value("shifts_ok", i), 1, 1e-6f);
    }
    ASSERT_EQ(run(folder_, "render box.xml -m pt --size 24x16 --spp 1 --buffers -o pt.exr").exit_code, 0);
    EXPECT_EQ(find_layer(read_exr(folder_ / "pt.exr"), "shifts_ok"), nullptr);
}

TEST_F(CommandLine, NumberOfThreadsDoesNotChangeTheFile) {
    const std::string render = "render box.xml -m gpr --size 40x30 --spp 2 --buffers ";
    ASSERT_EQ(run(folder_, render + "--threads 1 -o one.exr").exit_code, 0);
    ASSERT_EQ(run(folder_, render + "--threads 2 -o two.exr").exit_code, 0);
    const ExrFile one = read_exr(folder_ / "one.exr"), two = read_exr(folder_ / "two.exr");
    ASSERT_EQ(one.layers.size(), two.layers.size());
    for (std::size_t i = 0; i < one.layers.size(); ++i)
        EXPECT_TRUE(
            std::equal(one.layers[i].image.begin(), one.layers[i].image.end(), two.layers[i].image.begin()));
}

TEST_F(CommandLine, TimeLimitEndsARender) {
    const Outcome o =
        run(folder_, "render box.xml -m pt --size 64x64 --time 0.3 --clock cpu -o out.exr --stats s.json");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    const auto stats = nlohmann::json::parse(std::ifstream(folder_ / "s.json"));
    EXPECT_GE(stats["seconds"]["render"]["cpu"], 0.3);
    EXPECT_GT(stats["spp"], 1);
}

TEST_F(CommandLine, InterruptSavesThePicture) {
    const pid_t child = fork();
    if (child == 0) {
        if (chdir(folder_.c_str()) != 0 || !std::freopen("log.txt", "w", stderr))
            _exit(100);
        execl(TESSERA_BINARY, "tessera", "render", "box.xml", "-m", "pt", "--size", "64x64", "--spp", "3000", "-o",
              "out.exr", "--stats", "s.json", static_cast<char*>(nullptr));
        _exit(101);
    }
    // Progress is logged after a tenth of the passes. Their number is large enough for some seconds on any
    // machine.
    EXPECT_TRUE(eventually([&] {
        return fs::exists(folder_ / "log.txt") && fs::file_size(folder_ / "log.txt") > 0;
    })) << "no progress is logged";
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(read_exr(folder_ / "out.exr").layers.at(0).image.width(), 64);
    const auto stats = nlohmann::json::parse(std::ifstream(folder_ / "s.json"));
    EXPECT_EQ(stats["interrupted"], true);
    EXPECT_LT(stats["spp"], 3000);
}

TEST_F(CommandLine, ViewWithoutADisplayWritesAPicture) {
    const Outcome o = run(folder_, "view box.xml --size 48x32 --threads 2 --seconds 0.2");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    EXPECT_NE(o.output.find("no display"), std::string::npos) << o.output;
    EXPECT_GT(fs::file_size(folder_ / "contact-sheet.png"), 1000u);
}

TEST_F(CommandLine, InspectWithoutADisplayIsAnError) {
    const Outcome o = run(folder_, "view box.xml --size 48x32 --inspect 1,2,0 --seconds 0.2");
    EXPECT_EQ(o.exit_code, 2) << o.output;
    EXPECT_NE(o.output.find("There is no display for --inspect 1,2,0"), std::string::npos) << o.output;
    EXPECT_FALSE(fs::exists(folder_ / "contact-sheet.png"));
}

TEST_F(CommandLine, InfoDescribesTheScene) {
    write("odd.xml", "<scene version=\"3.0.0\">\n<bsdf type='velvet' id='a'/>\n<bsdf type='velvet' id='b'/>\n"
                     "<shape type='cube'><bsdf type='dielectric'/></shape></scene>");
    const Outcome o = run(folder_, "info odd.xml");
    ASSERT_EQ(o.exit_code, 0);
    for (const char* word :
         {"shapes     1\n", "triangles  12\n", "materials", "textures", "lights", "film", "seconds", "XML",
          "memory", "MB BVH", "delta lobes      1 material\n", "transmission     1 material\n",
          "glossy below 0.1 none\n", "relief           none\n", "masks            none\n",
          "environment      none\n",
          "odd.xml:2:1: the bsdf 'velvet' is not known; diffuse magenta is used instead (also at 3:1)\n"})
        EXPECT_NE(o.output.find(word), std::string::npos) << word << "\n" << o.output;
    EXPECT_EQ(run(folder_, "info box.xml").output.find("\x1b"), std::string::npos)
        << "a progress bar without a terminal";
}

TEST_F(CommandLine, CameraFileReplacesTheScenesCamera) {
    Camera own = load_mitsuba_xml(box_).description.camera;
    write_camera(folder_ / "own.json", own);
    own.fov *= 0.5f;
    write_camera(folder_ / "near.json", own);
    const std::string render = "render box.xml -m pt --size 24x16 --spp 1 ";
    ASSERT_EQ(run(folder_, render + "-o plain.exr").exit_code, 0);
    ASSERT_EQ(run(folder_, render + "--camera own.json -o own.exr").exit_code, 0);
    ASSERT_EQ(run(folder_, render + "--camera near.json -o near.exr").exit_code, 0);
    const auto same = [&](const char* a, const char* b) {
        const RgbImage one = read_exr(folder_ / a).layers.at(0).image,
                       two = read_exr(folder_ / b).layers.at(0).image;
        return std::equal(one.begin(), one.end(), two.begin());
    };
    EXPECT_TRUE(same("plain.exr", "own.exr"));
    EXPECT_FALSE(same("plain.exr", "near.exr"));
    const Outcome plain = run(folder_, "info box.xml"), with = run(folder_, "info box.xml --camera near.json");
    EXPECT_EQ(with.exit_code, 0);
    EXPECT_EQ(std::count(with.output.begin(), with.output.end(), '\n'),
              std::count(plain.output.begin(), plain.output.end(), '\n'));
    EXPECT_EQ(run(folder_, "view box.xml --camera near.json --size 24x16 --seconds 0.1").exit_code, 0);
}

// The values of each field are tested with the reader. Here, every command ends with its message.
TEST_F(CommandLine, BadCameraFilesGetAMessageAndExitCode2) {
    const std::string unit = "\"to_world\": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "c.json:1:1: the file is empty"},
        {"{\n  \"fov\": 40,\n}", "c.json:3:1: the JSON is broken"},
        {"{\"fov\": nan}", "c.json:1:10: the JSON is broken: invalid literal\n"},
        {"[]", "c.json:1:1: a camera file holds one object"},
        {"{\"fov\": 40}", "c.json:1:1: the camera has no 'to_world'"},
        {"{" + unit + "}", "c.json:1:1: the camera has no 'fov'"},
        {"{" + unit + ",\n \"fov\": \"wide\"}", "c.json:2:9: 'fov' must be numeric, not string"},
        {"{" + unit + ",\n \"fov\": 180}", "c.json:2:9: the field of view must be between 0 and 180 degrees"},
        {"{" + unit + ",\n \"fov\": 40, \"zoom\": 2}", "c.json:2:21: unknown camera field 'zoom'"},
        {"{\"fov\": 40, \"to_world\": [0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,1]}", "the camera's transform is flat"},
    };
    for (const auto& [json, expected] : cases) {
        write("c.json", json);
        for (const char* command :
             {"render box.xml --spp 1 --size 16x16 -o out.exr", "info box.xml", "view box.xml"}) {
            const Outcome o = run(folder_, std::string(command) + " --camera c.json");
            EXPECT_EQ(o.exit_code, 2) << json << "\n" << o.output;
            EXPECT_NE(o.output.find(expected), std::string::npos) << json << "\n" << o.output;
        }
        EXPECT_FALSE(fs::exists(folder_ / "out.exr"));
    }
    EXPECT_NE(run(folder_, "info box.xml --camera none.json").output.find("none.json: cannot open"),
              std::string::npos);
}

} // namespace

} // namespace tessera::test
