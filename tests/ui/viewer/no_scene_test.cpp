// Panes show the reason for a missing or black picture.

#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"
#include "tests/ui/viewer_harness.h"
#include "ui/panes/pane_parts.h"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <imgui.h>

namespace tessera::test {
namespace {

TEST(NoScene, PanesReportABrokenSceneWithButtons) {
    ViewerHarness h;
    bool is_broken = true;
    h.viewer.load("room.xml", [&](SceneNotes&, LoadProgress&) -> std::shared_ptr<const Scene> {
        if (is_broken)
            throw std::runtime_error("room.xml:3: <shape> is not closed");
        return viewer_scene();
    });
    h.wait_until([&] { return !h.viewer.loading(); });
    h.frames(3);
    EXPECT_EQ(status_text(h.state(), 0), "PT   no scene");
    EXPECT_NE(h.state().scene_info.problem.text.find("room.xml:3"), std::string::npos);
    ASSERT_TRUE(h.has("no_scene.why"));
    h.save("no-scene.png");
    h.click("no_scene.open");
    EXPECT_EQ(h.state().layout.choosing, FilePurpose::scene);
    h.type(Key::escape);
    is_broken = false;
    h.click("no_scene.again");
    h.wait_until([&] { return h.state().scene != nullptr; });
    h.frames(2);
    EXPECT_FALSE(h.has("no_scene.why"));
    EXPECT_EQ(h.state().scene_info.problem.text, "");
}

TEST(NoScene, PanesReportACancelledLoad) {
    ViewerHarness h;
    std::atomic<bool> goes_on = false;
    h.viewer.load("room.xml", [&](SceneNotes&, LoadProgress&) {
        while (!goes_on)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return viewer_scene();
    });
    h.frames(3);
    EXPECT_FALSE(h.has("no_scene.why")) << "the scene is loading";
    h.click("cancel_load");
    goes_on = true;
    h.frames(3);
    EXPECT_TRUE(h.has("no_scene.why"));
    EXPECT_NE(h.state().scene_info.problem.text.find("was cancelled"), std::string::npos);
}

/// Counts the pixels in the middle of a pane that are not black.
int lit_pixels(const ViewerHarness& h) {
    const ControlRect rect = h.place("pane0.picture");
    const ScreenPixels screen = h.screen();
    int count = 0;
    for (int y = static_cast<int>(rect.center().y) - 40; y < static_cast<int>(rect.center().y) + 40; ++y)
        for (int x = static_cast<int>(rect.min.x) + 4; x < static_cast<int>(rect.max.x) - 4; ++x)
            count += screen.at(x, y)[0] > 60;
    return count;
}

TEST(NoScene, ABlackPictureShowsText) {
    ViewerHarness h;
    h.state().rendering.pace.spp_limit = 1;
    h.viewer.load("dark", [](SceneNotes&, LoadProgress&) {
        SceneBuilder room;
        const int white = room.diffuse(Rgb(0.75f));
        room.room({white, white, white, white, white});
        room.camera({0, 0, 3.4f}, {0, 0, 0}, 40);
        return room.build();
    });
    h.wait_until([&] { return h.viewer.settled(1); });
    h.frames(3);
    h.save("no-light.png");
    EXPECT_TRUE(h.viewer.pictures().image(0).is_black());
    EXPECT_GT(lit_pixels(h), 200);
    h.viewer.load("a room", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
    h.wait_until([&] { return h.state().scene_info.shown == 2 && h.viewer.settled(1); });
    h.frames(3);
    EXPECT_FALSE(h.viewer.pictures().image(0).is_black());
}

TEST(NoScene, APaneReportsWhyItsRenderFailed) {
    ViewerHarness h;
    h.load_scene();
    h.state().panes[1].settings.render.tile = 99; // beyond all limits
    h.wait_until([&] { return h.pane(1).failed; });
    h.frames(2);
    h.save("failed.png");
    EXPECT_NE(h.pane(1).failure.find("tile"), std::string::npos) << h.pane(1).failure;
}

TEST(Modes, AreShownInPanesAndLeaveSpaceForMessages) {
    ViewerHarness h;
    h.rest(2);
    EXPECT_FALSE(h.has("pane0.mode"));
    h.type(Key::i);
    h.frames(2);
    EXPECT_TRUE(h.has("pane0.mode"));
    EXPECT_TRUE(h.has("pane1.mode"));
    h.move_to(h.place("pane0.picture").center());
    EXPECT_EQ(ImGui::GetMouseCursor(),
              ImGuiMouseCursor_Hand); // a click chooses a pixel, and does not move the camera
    h.state().add_message(Message::Kind::error, "something went wrong");
    h.frames(3);
    h.save("mode-and-messages.png");
    EXPECT_TRUE(h.has("clear_messages"));
    EXPECT_TRUE(h.has("inspector.direction")) << "the inspector's panel is hidden";
    EXPECT_LT(h.place("clear_messages").max.y, h.place("inspector.direction").min.y);
    h.type(Key::escape);
    h.frames(2);
    EXPECT_FALSE(h.state().inspector.active);
    EXPECT_EQ(ImGui::GetMouseCursor(), ImGuiMouseCursor_Arrow);
    EXPECT_FALSE(h.has("pane0.mode"));
}

} // namespace
} // namespace tessera::test
