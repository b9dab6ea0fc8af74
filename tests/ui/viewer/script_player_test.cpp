#include "render/scene/scene.h"
#include "tests/ui/viewer_harness.h"
#include "ui/viewer/script.h"

#include <sstream>

#include <gtest/gtest.h>

namespace tessera::test {
namespace {

struct Play : testing::Test, ViewerHarness {
    std::vector<std::string> printed;
    std::vector<std::string> pictures;

    void play(const std::string& text) {
        std::istringstream stream(text);
        ScriptPlayer player(parse_script(stream, "steps.txt"), "steps.txt", viewer,
                            {[&](const std::string& line) { printed.push_back(line); },
                             [&](const std::filesystem::path& file) { pictures.push_back(file.string()); }});
        wait_until([&] {
            player.before_frame(0.01);
            frame();
            player.after_frame();
            return player.done();
        });
    }
    std::string error_of(const std::string& text) {
        try {
            play(text);
        } catch (const ScriptError& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(Play, KeysMouseAndSettings) {
    state().rendering.pace.spp_limit = 2;
    viewer.load("a room", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
    play("wait scene\nwait spp 2\nset tile 4\nwait spp 2\nscreenshot a.png\nprint \"all done\"");
    EXPECT_EQ(pane(1).snapshot->settings.tile, 4);
    EXPECT_EQ(pictures, std::vector<std::string>{"a.png"});
    EXPECT_EQ(printed, std::vector<std::string>{"all done"});

    play("click pane0.picture\nkey V");
    EXPECT_EQ(state().active_pane, 0);
    EXPECT_EQ(pane(0).settings.comparison.kind, Comparison::Kind::wipe);
    play("drag pane0.picture@0.5,0.5 pane0.picture@0.25,0.5");
    EXPECT_NEAR(state().layout.wipe, 0.25f, 0.01f);
    play("choose pane0.method gpt\nclick \"menu Buffer\"\nclick \"menu Buffer/Primal\"\nkey +");
    EXPECT_EQ(pane(0).settings.render.method, Method::gpt);
    EXPECT_EQ(pane(1).settings.buffer, Buffer::primal);
    EXPECT_EQ(state().display.tone.exposure, 0.5f);
    play("hold B");
    EXPECT_TRUE(state().layout.flicker);
    play("release B");
    EXPECT_FALSE(state().layout.flicker);
    play("modifiers ctrl\nmove pane1.picture\nwheel 3\nmodifiers none");
    EXPECT_NEAR(state().display.view.zoom(), 1.953f, 0.01f);
    play("quit");
    EXPECT_TRUE(state().wishes.quit);
}

TEST_F(Play, MeasuresFrames) {
    load_scene();
    play("frames 20 idle\norbit 10 dragging");
    ASSERT_EQ(printed.size(), 2u);
    EXPECT_EQ(printed[0], "frames idle: 20, median 10.0 ms, 99th percentile 10.0 ms");
    EXPECT_EQ(printed[1].rfind("frames dragging: 10, median 10.0 ms, 99th percentile 10.0 ms; ", 0), 0u);
    EXPECT_NE(printed[1].find(" pictures, "), std::string::npos) << printed[1];
    EXPECT_FALSE(state().camera.camera() == state().scene->camera());
}

TEST_F(Play, ErrorsNameFileAndLine) {
    load_scene();
    EXPECT_EQ(error_of("key M\nclick nothing"),
              "steps.txt:2: unknown control nothing (--log-actions lists all controls)");
    EXPECT_EQ(error_of("\nkey Hyper"), "steps.txt:2: unknown key Hyper");
    EXPECT_EQ(error_of("set tile 99").rfind("steps.txt:1: ", 0), 0u);
    EXPECT_EQ(error_of("wait long"), "steps.txt:1: usage: wait scene | spp N | seconds S | reference");
}

} // namespace
} // namespace tessera::test
