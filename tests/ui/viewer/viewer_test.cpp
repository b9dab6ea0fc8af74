#include "tests/ui/viewer_harness.h"
#include "ui/viewer/viewer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <thread>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

TEST(Viewer, ShowsPicturesOfBothPanes) {
    ViewerHarness h;
    h.load_scene();
    h.wait_until([&] { return h.pane(1).snapshot->reconstruction_spp >= 4; });
    h.frame();
    EXPECT_GT(h.brightness("pane0.picture"), 20);
    EXPECT_GT(h.brightness("pane1.picture"), 20);
    EXPECT_EQ(h.pane(0).snapshot->settings.method, Method::pt);
    EXPECT_EQ(h.pane(1).snapshot->settings.method, Method::gpr);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    h.save("viewer.png");
}

TEST(Viewer, DrawsWithoutASceneAndDuringALoad) {
    ViewerHarness h;
    h.frames(3);
    std::atomic<bool> go{false};
    h.viewer.load("a slow one", [&](SceneNotes&, LoadProgress&) {
        while (!go)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return viewer_scene();
    });
    h.frames(3); // frames do not wait: the scene is complete only afterwards
    EXPECT_TRUE(h.viewer.loading());
    EXPECT_LE(h.viewer.next_frame_in(), 0.1);
    EXPECT_EQ(h.pane(0).generation, 0u);
    h.save("loading.png");
    EXPECT_EQ(h.state().scene_info.loading, "scene file");
    go = true;
    h.wait_until([&] { return h.state().scene != nullptr; });
    EXPECT_EQ(h.state().scene_info.name, "a slow one");
    EXPECT_EQ(h.pane(0).settings.render.max_depth, 4);
}

TEST(Viewer, OldSceneStaysWhenTheNextFails) {
    ViewerHarness h;
    h.load_scene();
    const auto scene = h.state().scene;
    h.viewer.load("broken.xml", [](SceneNotes& notes, LoadProgress&) -> std::shared_ptr<const Scene> {
        notes.push_back({"line 3: ignored"});
        throw std::runtime_error("broken.xml:7:3: no such thing");
    });
    h.wait_until([&] { return !h.viewer.loading(); });
    h.frames(3);
    EXPECT_EQ(h.state().scene, scene);
    ASSERT_EQ(h.state().messages.size(), 2u);
    EXPECT_EQ(h.state().messages[0].kind, Message::Kind::note);
    EXPECT_EQ(h.state().messages[1].text, "broken.xml:7:3: no such thing");
    EXPECT_TRUE(h.state().layout.show_messages);
    EXPECT_TRUE(h.has("clear_messages"));
    h.save("messages.png");
    h.click("clear_messages");
    EXPECT_TRUE(h.state().messages.empty());
    EXPECT_FALSE(h.has("clear_messages"));
}

TEST(Viewer, EachChangeIsANewRequestInTheSameFrame) {
    ViewerHarness h;
    h.load_scene();
    const auto expect_new = [&](int pane, bool expected, const char* what) {
        const std::uint64_t before = h.pane(pane).generation;
        h.frame();
        EXPECT_EQ(h.pane(pane).generation > before, expected) << what;
    };
    expect_new(0, false, "nothing");
    h.state().panes[0].settings.render.method = Method::pr;
    expect_new(1, false, "the other pane's method");
    h.state().panes[0].settings.render.method = Method::gpt;
    expect_new(0, true, "method");
    h.state().panes[0].settings.render.tile = 3;
    expect_new(0, true, "tile");
    h.state().camera.dolly(0.9f);
    expect_new(1, true, "camera");
    h.state().rendering.size.custom = {40, 30};
    expect_new(0, true, "size");
    h.state().wishes.restart = true;
    expect_new(1, true, "restart");
    h.state().display.tone.exposure = 2;
    h.state().panes[0].settings.buffer = Buffer::primal;
    h.state().panes[0].settings.reconstruction.alpha = 1;
    expect_new(0, false, "what changes no samples");
}

TEST(Viewer, UploadsOnlyNewPictures) {
    ViewerHarness h;
    h.rest(2);
    h.frames(3);
    const int uploads = h.viewer.pictures().image(1).uploads(),
              drawings = h.viewer.pictures().view(1).canvas().drawings();
    h.frames(10);
    EXPECT_EQ(h.viewer.pictures().image(1).uploads(), uploads);
    EXPECT_EQ(h.viewer.pictures().view(1).canvas().drawings(), drawings);
    h.state().display.tone.exposure = 1;
    h.frames(2);
    EXPECT_EQ(h.viewer.pictures().image(1).uploads(), uploads);
    EXPECT_EQ(h.viewer.pictures().view(1).canvas().drawings(), drawings + 1);
    EXPECT_GT(h.viewer.next_frame_in(), 10);
}

TEST(Viewer, ReconstructionSettingsChangeThePictureWithoutNewSamples) {
    ViewerHarness h;
    h.rest(2);
    const auto before = h.pane(1).snapshot;
    h.state().panes[1].settings.reconstruction.alpha = 5;
    h.wait_until([&] { return h.pane(1).snapshot->reconstruction != before->reconstruction; });
    EXPECT_EQ(h.pane(1).snapshot->generation, before->generation);
    EXPECT_EQ(h.pane(1).snapshot->spp, before->spp);
}

TEST(Viewer, StopsAtItsLimitAndIsSettled) {
    ViewerOptions options = ViewerHarness::two_panes();
    options.spp_limit = 3;
    ViewerHarness h({900, 500}, 1, options);
    EXPECT_FALSE(h.viewer.settled(3));
    h.load_scene();
    h.wait_until([&] { return h.viewer.settled(3); });
    EXPECT_EQ(h.pane(0).snapshot->spp, 3);
    EXPECT_EQ(h.pane(1).snapshot->spp, 3);
    EXPECT_EQ(h.pane(1).snapshot->reconstruction_spp, 3);
    h.state().wishes.restart = true;
    h.frame();
    EXPECT_FALSE(h.viewer.settled(3));
}

TEST(Viewer, SurvivesBeingOnePixelLarge) {
    ViewerOptions options = ViewerHarness::two_panes();
    options.size = {}; // fits the pane
    ViewerHarness h({700, 400}, 1, options);
    h.load_scene();
    const glm::ivec2 before = h.state().request_size();
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(2, 300), glm::ivec2(700, 3), glm::ivec2(60, 60)}) {
        h.resize(size);
        h.type(Key::f1);
        h.state().layout.show_messages = true;
        h.frames(2);
        h.type(Key::f1);
    }
    h.state().layout.show_messages = false;
    h.resize({700, 400});
    h.type(Key::r); // some of these sizes may be latched, because few samples were lost
    EXPECT_EQ(h.state().request_size(), before);
    h.wait_until([&] {
        return h.pane(0).snapshot->generation == h.pane(0).generation && h.pane(0).snapshot->spp > 3 &&
               !h.pane(0).snapshot->coarse();
    });
    h.frames(2);
    EXPECT_GT(h.brightness("pane0.picture"), 20);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(Viewer, WorksAtScalesOfTwoAndThree) {
    for (float scale : {2.0f, 3.0f}) {
        ViewerHarness h({1920, 1200}, scale);
        h.load_scene();
        h.choose("pane0.method", "gpt");
        EXPECT_EQ(h.pane(0).settings.render.method, Method::gpt);
        EXPECT_GT(h.place("tile").max.y - h.place("tile").min.y, 20 * scale);
        h.save("scale" + std::to_string(static_cast<int>(scale)) + ".png");
    }
}

TEST(Viewer, ScaleChangesWhileRunning) {
    ViewerHarness h;
    h.frames(2);
    const float before = h.place("tile").max.y - h.place("tile").min.y;
    h.scale_ = 1.5f; // moved to another display
    h.frames(3);
    EXPECT_NEAR(h.place("tile").max.y - h.place("tile").min.y, before * 1.5f, 2);
    EXPECT_GT(h.brightness("restart"), 40); // and the button is drawn
}

TEST(Viewer, ReportsThatAMethodHasNoGradients) {
    ViewerHarness h;
    h.load_scene();
    h.state().panes[0].settings.buffer = Buffer::dx;
    h.state().panes[1].settings.buffer = Buffer::dx;
    h.wait_until([&] { return h.pane(1).snapshot->spp > 8; });
    h.frames(2);
    EXPECT_TRUE(h.viewer.pictures().image(0).empty());
    EXPECT_FALSE(h.viewer.pictures().image(1).empty());
    h.save("gradients.png");
}

TEST(Viewer, LogsChangesAndControls) {
    std::vector<std::string> lines;
    ViewerOptions options = ViewerHarness::two_panes();
    options.log = [&](const std::string& line) { lines.push_back(line); };
    options.log_controls = true;
    ViewerHarness h({1280, 720}, 1, options);
    h.load_scene();
    h.choose("pane0.method", "gpr");
    const auto said = [&](const std::string& line) {
        return std::find(lines.begin(), lines.end(), line) != lines.end();
    };
    EXPECT_TRUE(said("pane 0 method pt"));
    EXPECT_TRUE(said("pane 0 method gpr"));
    EXPECT_TRUE(said("pane 1 method gpr"));
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(),
                            [](const std::string& l) { return l.rfind("control pane0.method/gpr ", 0) == 0; }));
    h.state().rendering.paused = true;
    // When the pass under way has ended and its status is shown, nothing moves, and no frame logs controls.
    bool quiet = false;
    for (int attempt = 0; attempt < 200 && !quiet; ++attempt) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        lines.clear();
        h.frames(3);
        quiet = std::none_of(lines.begin(), lines.end(),
                             [](const std::string& l) { return l.rfind("control", 0) == 0; });
    }
    EXPECT_TRUE(quiet);
}

TEST(Viewer, FourPanesInAGrid) {
    ViewerOptions options = ViewerHarness::two_panes();
    options.panes.resize(4);
    options.panes[2].render.method = Method::pr;
    options.panes[3].render.method = Method::gpt;
    ViewerHarness h({1280, 800}, 1, options);
    h.load_scene();
    EXPECT_GT(h.place("pane2.picture").min.y, h.place("pane0.picture").max.y);
    EXPECT_GT(h.place("pane3.picture").min.x, h.place("pane2.picture").max.x);
    h.wait_until([&] { return h.pane(3).snapshot && h.pane(3).snapshot->spp > 2; });
    h.save("four.png");
}

} // namespace
} // namespace tessera::test
