// The path inspector: a pixel is chosen by the mouse, and its sample drawn and listed.

#include "tests/ui/viewer_harness.h"
#include "ui/path_overlay.h"

#include <gtest/gtest.h>

namespace tessera::test {
namespace {

struct PathInspector : testing::Test, ViewerHarness {
    PathInspector() { rest(3); }

    const Inspector& inspector() { return state().inspector; }
    glm::vec2 middle(int index, glm::ivec2 pixel) {
        const Placement placement = state().view.place({48, 36}, pane(index).canvas_size);
        const glm::vec2 share = (glm::vec2(pixel) + 0.5f) / glm::vec2(48, 36);
        return place("pane" + std::to_string(index) + ".picture").min + placement.origin +
               share * placement.extent;
    }
    void inspect_pixel(int index, glm::ivec2 pixel) {
        click(middle(index, pixel));
        wait_until([&] { return inspector().inspection && inspector().inspection->pixel == pixel; });
        frames(3);
    }
};

TEST_F(PathInspector, AClickChoosesAPixelAndMovesNoCamera) {
    const auto camera = state().camera.camera();
    type(Key::i);
    EXPECT_TRUE(has("inspector.direction"));
    const ScreenPixels before = screen();
    inspect_pixel(1, {16, 14});
    EXPECT_TRUE(state().camera.camera() == camera);
    EXPECT_EQ(inspector().pane, 1);
    EXPECT_EQ(inspector().inspection->pass, 2);
    EXPECT_EQ(inspector().inspection->method, Method::gpr);
    ASSERT_EQ(inspector().inspection->sets.size(), 1u);
    EXPECT_FALSE(inspector().inspection->path.empty());
    EXPECT_TRUE(has("vertices.pdf_w"));
    EXPECT_TRUE(has("shifts.outcome"));
    save("inspector.png");
    EXPECT_NE(screen().rgb, before.rgb);
    // x1 lies in the pixel that was clicked.
    const Projection projection(camera, {48, 36});
    const glm::vec3 seen = projection.project(inspector().inspection->path.front().position);
    EXPECT_EQ(glm::ivec2(glm::vec2(seen) / seen.z), glm::ivec2(16, 14));
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(PathInspector, DirectionsListDifferentShifts) {
    type(Key::i);
    inspect_pixel(1, {16, 14});
    const std::size_t all = inspector().inspection->sets[0].pixels.size();
    EXPECT_EQ(shown_shifts(inspector()).size(), all);
    choose("inspector.direction", "from_pixel");
    EXPECT_EQ(inspector().direction, Inspector::Direction::from_pixel);
    EXPECT_EQ(shown_shifts(inspector()).size(), all - 1);
    save("inspector-from.png");
}

TEST_F(PathInspector, TheSampleStaysUntilItIsToFollow) {
    type(Key::i);
    inspect_pixel(0, {30, 20});
    state().pace.spp_limit = 5;
    wait_until([&] { return viewer.settled(5); });
    frames(5);
    EXPECT_EQ(inspector().inspection->pass, 2);
    click("inspector.follow");
    EXPECT_TRUE(inspector().follows);
    EXPECT_TRUE(wait_until([&] { return inspector().inspection->pass == 4; }));
}

TEST_F(PathInspector, AnotherRequestIsLookedAtAnew) {
    type(Key::i);
    inspect_pixel(1, {16, 14});
    const std::uint64_t generation = inspector().generation;
    state().panes[1].settings.render.method = Method::pr;
    EXPECT_TRUE(wait_until([&] { return inspector().generation > generation; }));
    EXPECT_EQ(inspector().inspection->method, Method::pr);
    type(Key::digit1, true); // the pane is no more
    frames(5);
    click("inspector.close");
    EXPECT_FALSE(inspector().active);
    frames(3);
    EXPECT_FALSE(has("inspector.direction"));
}

TEST_F(PathInspector, OpensTheSampleOfAMessage) {
    Message message{Message::Kind::note, "a bad sample", Message::Origin::viewer, SampleChoice{1, {7, 9}, 1}};
    state().messages.push_back(message);
    type(Key::f2);
    const std::string button = "inspect_message" + std::to_string(state().messages.size() - 1);
    ASSERT_TRUE(has(button));
    click(button);
    EXPECT_TRUE(inspector().active);
    ASSERT_TRUE(wait_until([&] { return inspector().inspection != nullptr; }));
    EXPECT_EQ(inspector().inspection->pixel, glm::ivec2(7, 9));
    EXPECT_EQ(inspector().inspection->pass, 1);
}

} // namespace
} // namespace tessera::test
