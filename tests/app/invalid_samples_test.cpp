// The program reports invalid samples with a command, and the viewer opens exactly these samples.
#include "app/cli/render_stats.h"
#include "render/scene/scene.h"
#include "tests/app/program.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/rooms.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include <glm/vec2.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr glm::ivec2 size(24, 16);
constexpr InvalidSample sample{5, 2, 7};

std::string command(const SceneSource& source, const RenderSettings& settings) {
    const auto scene = Room().build();
    return inspect_command(source, Render(scene, scene->camera(), size, settings), sample);
}

RenderSettings default_settings() {
    RenderSettings settings;
    settings.max_depth = Room().build()->max_depth(); // the default depth
    settings.max_depth = std::min(settings.max_depth, most_edges);
    return settings;
}

TEST(InspectCommand, HasTheSettingsThatDifferFromDefaults) {
    EXPECT_EQ(command({"box.xml", {}, {}}, default_settings()),
              "tessera view box.xml --size 24x16 --inspect 7,2,5");
    RenderSettings settings = default_settings();
    settings.method = Method::pr;
    settings.tile = 4;
    settings.adapt_tile = false;
    settings.shift = ShiftKind::reconnection;
    settings.rr_delta = 1.0f / 3; // needs all digits
    settings.max_depth = 3;
    settings.seed = 12345678901234567890u;
    EXPECT_EQ(command({"box.xml", {}, {}}, settings),
              "tessera view box.xml -m pr --size 24x16 --tile 4 --no-adapt-tile --rr-delta 0.33333334 --shift "
              "reconnection --max-depth 3 --seed 12345678901234567890 --inspect 7,2,5");
}

TEST(InspectCommand, IsQuotedForAShell) {
    EXPECT_EQ(command({"my scenes/it's.xml", {{"unit", "1 m"}, {"n", "2"}}, "near by.json"}, default_settings()),
              "tessera view 'my scenes/it'\\''s.xml' -D n=2 -D 'unit=1 m' --camera 'near by.json' --size 24x16 "
              "--inspect 7,2,5");
}

TEST(InspectCommand, IsEmptyForPicturesTooLargeForTheViewer) {
    const auto scene = Room().build();
    const Render render(scene, scene->camera(), {9000, 1}, default_settings());
    EXPECT_EQ(inspect_command({"box.xml", {}, {}}, render, sample), "");
}

/// Writes the Cornell box with a light that overflows floats.
class InvalidSampleReports : public testing::Test {
protected:
    InvalidSampleReports() {
        std::ifstream in(fs::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml");
        std::string text{std::istreambuf_iterator<char>(in), {}};
        text.insert(text.rfind("</scene>"),
                    "<default name='light' value='3e38'/>\n"
                    "<shape type='rectangle'><transform name='to_world'><scale value='0.1'/>"
                    "<translate y='1' z='-0.97'/></transform><emitter type='area'>"
                    "<texture name='radiance' type='checkerboard'>"
                    "<rgb name='color0' value='$light'/><rgb name='color1' value='$light'/>"
                    "</texture></emitter></shape>\n");
        std::ofstream(folder() / "too bright.xml") << text;
    }
    const fs::path& folder() const { return folder_.path(); }
    Outcome tessera(const std::string& arguments) const { return run(folder(), arguments); }

    static constexpr const char* options =
        " 'too bright.xml' -D light=2e38 --size 24x16 --max-depth 4 --tile 5 --threads 1 ";
    TemporaryFolder folder_;
};

TEST_F(InvalidSampleReports, OfARenderOpenTheSampleInTheViewer) {
    const Outcome o =
        tessera("render" + std::string(options) + "--seed 9 --spp 3 --recon none -o out.exr --stats out.json");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    const auto stats = nlohmann::json::parse(std::ifstream(folder() / "out.json"));
    ASSERT_FALSE(stats.at("first_refused").empty()) << o.output;
    for (const auto& [i, refused] : stats.at("first_refused").items()) {
        const int x = refused.at("x"), y = refused.at("y"), pass = refused.at("pass");
        EXPECT_EQ(refused.at("seed"), 9);
        const std::string expected =
            "tessera view 'too bright.xml' -D light=2e38 --size 24x16 --tile 5 --max-depth 4 "
            "--seed 9 --inspect " +
            std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(pass);
        EXPECT_EQ(refused.at("inspect"), expected);
        EXPECT_EQ(o.output.find(expected + "\n") != std::string::npos, i == "0") << o.output;
    }
    const auto& last = stats.at("first_refused").back();
    const std::string inspect = last.at("inspect");
    const Outcome seen =
        tessera(inspect.substr(inspect.find("view")) + " --spp 1 --screenshot shot.png --log-actions --threads 1");
    if (seen.output.find("There is no display") != std::string::npos)
        GTEST_SKIP() << "there is no display";
    EXPECT_EQ(seen.exit_code, 0) << seen.output;
    EXPECT_THAT(seen.output, HasSubstr("inspection gpr pixel " + std::to_string(int(last.at("x"))) + " " +
                                       std::to_string(int(last.at("y"))) + " pass " +
                                       std::to_string(int(last.at("pass"))) + " refused\n"));
}

TEST_F(InvalidSampleReports, CoverReferencesAndBenchmarks) {
    const Outcome reference = tessera("reference" + std::string(options) + "--spp 2 -o ref.exr");
    for (const char* seed : {"1001", "1002"}) // seeds of both halves
        EXPECT_THAT(reference.output, HasSubstr("--tile 5 --max-depth 4 --path-guiding off --seed " +
                                                std::string(seed) + " --inspect "));
    const Outcome bench =
        tessera("bench 'too bright.xml' --size 24x16 --max-depth 4 --spp 2 --methods pt --seeds 1 "
                "--reference refs --reference-spp 2 -o out");
    EXPECT_THAT(bench.output,
                HasSubstr("tessera view 'too bright.xml' -m pt --size 24x16 --max-depth 4 --inspect "));
}

TEST_F(InvalidSampleReports, AreAbsentWithoutInvalidSamples) {
    const Outcome o = tessera("render 'too bright.xml' -D light=1 --size 8x8 --spp 1 -o out.exr --stats s.json");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    EXPECT_THAT(o.output, Not(HasSubstr("--inspect")));
    EXPECT_EQ(nlohmann::json::parse(std::ifstream(folder() / "s.json")).at("first_refused"),
              nlohmann::json::array());
}

TEST_F(InvalidSampleReports, ViewerOptionsAreChecked) {
    const std::pair<const char*, const char*> cases[] = {
        {"--inspect 7,2", "--inspect 7,2: must be X,Y,PASS"},
        {"--inspect 7,2,-1", "must be X,Y,PASS"},
        {"--inspect 7,2,0,9", "must be X,Y,PASS"},
        {"--inspect 0,0,4294967296", "must be X,Y,PASS"},
        {"--inspect 7,2,0 --size 9000x16", "from 1 to 8192"},
        {"-m gpr,pt,pr,gpt,pt", "at most 4 methods"},
        {"-m bdpt", "bdpt"},
        {"-m gpr --panes 2", "excludes"},
    };
    for (const auto& [arguments, expected] : cases) {
        const Outcome o = tessera("view 'too bright.xml' " + std::string(arguments));
        EXPECT_EQ(o.exit_code, 2) << arguments << "\n" << o.output;
        EXPECT_THAT(o.output, HasSubstr(expected)) << arguments;
    }
}

} // namespace

} // namespace tessera::test
