// The path inspector: choice of a pixel by the mouse, and display of its sample.

#include "render/inspect/inspection.h"
#include "tests/ui/viewer_harness.h"
#include "ui/inside/inside.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

struct PathInspector : testing::Test, ViewerHarness {
    PathInspector() { rest(3); }

    const Inspector& inspector() { return state().inspector; }
    glm::vec2 middle(int index, glm::ivec2 pixel) {
        const Placement placement = state().display.view.place({48, 36}, pane(index).canvas_size);
        const glm::vec2 share = (glm::vec2(pixel) + 0.5f) / glm::vec2(48, 36);
        return place("pane" + std::to_string(index) + ".picture").min + placement.origin +
               share * placement.extent;
    }
    void double_click() {
        for (int i = 0; i < 2; ++i) {
            press();
            release();
        }
        frames(2);
    }
    void inspect_pixel(int index, glm::ivec2 pixel) {
        click(middle(index, pixel));
        wait_until([&] { return inspector().inspection && inspector().inspection->pixel == pixel; });
        frames(3);
    }
    /// Whether the scene is destroyed when another scene replaces it.
    bool lets_go_of_the_scene() {
        const std::weak_ptr<const Scene> before = state().scene;
        viewer.load("another", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
        wait_until([&] { return state().scene_info.shown == 2 && viewer.settled(3); });
        return wait_until([&] { return before.expired(); });
    }
};

TEST_F(PathInspector, AClickChoosesAPixelAndMovesNoCamera) {
    const auto camera = state().camera.camera();
    type(Key::i);
    EXPECT_TRUE(has("inspector.direction"));
    const ScreenPixels before = screen();
    inspect_pixel(1, {16, 14});
    EXPECT_TRUE(state().camera.camera() == camera);
    EXPECT_EQ(inspector().slot, 1);
    EXPECT_EQ(inspector().inspection->pass, 2);
    EXPECT_EQ(inspector().inspection->method, Method::gpr);
    ASSERT_FALSE(inspector().inspection->sets.empty());
    EXPECT_FALSE(inspector().inspection->path.empty());
    EXPECT_TRUE(has("vertices.pdf_w"));
    EXPECT_TRUE(has("shifts.outcome"));
    save("inspector.png");
    EXPECT_NE(screen().rgb, before.rgb);
    // x1 lies in the pixel clicked.
    const Projection projection(camera, {48, 36});
    const glm::vec4 seen = projection.project(inspector().inspection->path.front().position);
    EXPECT_EQ(glm::ivec2(glm::vec2(seen) / seen.w), glm::ivec2(16, 14));
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(PathInspector, DirectionsListDifferentShifts) {
    type(Key::i);
    inspect_pixel(1, {16, 14});
    const std::vector<InspectedSet>& sets = inspector().inspection->sets;
    std::size_t all = 0;
    for (const InspectedSet& set : sets)
        all += set.pixels.size();
    EXPECT_EQ(shown_shifts(inspector()).size(), all);
    choose("inspector.direction", "from_pixel");
    EXPECT_EQ(inspector().direction, Inspector::Direction::from_pixel);
    EXPECT_EQ(shown_shifts(inspector()).size(), all - sets.size());
    save("inspector-from.png");
}

TEST_F(PathInspector, ARowListsTheVerticesOfItsShift) {
    type(Key::i);
    inspect_pixel(1, {16, 14});
    EXPECT_TRUE(has("vertices.Jacobian"));
    EXPECT_TRUE(has("vertices.value"));
    EXPECT_TRUE(has("vertices.ratio"));
    EXPECT_TRUE(has("shifts.Jacobian"));
    const ScreenPixels base = screen();
    const ControlRect first = place("shifts.row0");
    click(glm::vec2(first.min.x + 20, first.center().y));
    EXPECT_EQ(inspector().chosen, 0);
    move_to({20, 200});
    EXPECT_EQ(inspector().marked, -1);
    save("inspector-row.png");
    EXPECT_NE(screen().rgb, base.rgb); // other vertices, and the shift is highlighted
    click(glm::vec2(first.min.x + 20, first.center().y));
    EXPECT_EQ(inspector().chosen, -1);
    click(glm::vec2(first.min.x + 20, first.center().y));
    inspect_pixel(1, {20, 20});
    EXPECT_EQ(inspector().chosen, -1);
}

TEST_F(PathInspector, ThePixelsTileIsMarked) {
    type(Key::i);
    const ScreenPixels before = screen();
    inspect_pixel(1, {16, 14});
    const ScreenPixels after = screen();
    const InspectedSet& set = inspector().inspection->sets[0];
    ASSERT_GT(set.size(), 1);
    int changed = 0, brings = 0;
    for (const InspectedShift* s : set.to({16, 14})) {
        if (s->from == s->to || is_black(s->value))
            continue;
        const glm::vec2 at = middle(1, s->from) + glm::vec2(3, 4); // beside the lines
        const std::uint8_t* a = before.at(static_cast<int>(at.x), static_cast<int>(at.y));
        const std::uint8_t* b = after.at(static_cast<int>(at.x), static_cast<int>(at.y));
        changed += b[1] - a[1] > b[0] - a[0]; // the green of successful shifts
        ++brings;
    }
    EXPECT_GT(brings, 0);
    EXPECT_GE(changed * 4, brings * 3);
}

TEST_F(PathInspector, TheViewInSpaceOrbitsAndZooms) {
    type(Key::i);
    inspect_pixel(1, {16, 14});
    ASSERT_TRUE(wait_until([&] { return state().space.surroundings != nullptr; }));
    frames(3);
    const ControlRect rect = place("space");
    const auto pictured = [&] {
        const ScreenPixels pixels = screen();
        std::vector<std::uint8_t> part;
        for (int y = static_cast<int>(rect.min.y) + 2; y < static_cast<int>(rect.max.y) - 2; ++y)
            for (int x = static_cast<int>(rect.min.x) + 2; x < static_cast<int>(rect.max.x) - 2; ++x)
                part.insert(part.end(), pixels.at(x, y), pixels.at(x, y) + 3);
        return part;
    };
    const auto at_first = pictured();
    EXPECT_GT(std::count(at_first.begin(), at_first.end(), 255), 100); // the base path is white
    const Camera fitted = state().space.camera.camera(), scene = state().camera.camera();
    // All vertices are visible.
    const glm::ivec2 size(glm::vec2(rect.max - rect.min));
    for (const InspectedVertex& x : inspector().inspection->path) {
        const glm::vec4 p = Projection(fitted, size).project(x.position);
        ASSERT_GT(p.z, 0);
        EXPECT_TRUE(p.x / p.w > 0 && p.y / p.w > 0 && p.x / p.w < static_cast<float>(size.x) &&
                    p.y / p.w < static_cast<float>(size.y));
    }
    save("space.png");
    move_to(rect.center());
    wheel(3);
    EXPECT_FALSE(state().space.camera.camera() == fitted);
    double_click();
    EXPECT_FALSE(state().space.fits); // the whole path is shown again from this direction
    for (int i = 0; i < 4; ++i)
        EXPECT_LT(glm::distance(state().space.camera.camera().to_world[i], fitted.to_world[i]), 1e-3f) << i;

    drag(rect.center(), {40, 15});
    EXPECT_FALSE(state().space.camera.camera() == fitted);
    EXPECT_NE(pictured(), at_first);
    const float distance = state().space.camera.distance();
    wheel(3);
    EXPECT_LT(state().space.camera.distance(), distance);
    modifiers(false, true);
    const glm::vec3 forward = state().space.camera.forward();
    drag(rect.center(), {10, 0});
    modifiers(false, false);
    EXPECT_LT(glm::distance(state().space.camera.forward(), forward), 1e-4f);
    EXPECT_TRUE(state().camera.camera() == scene); // the pane's camera does not move
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(PathInspector, TheSampleStaysUnlessItFollows) {
    type(Key::i);
    inspect_pixel(0, {30, 20});
    state().rendering.pace.spp_limit = 5;
    wait_until([&] { return viewer.settled(5); });
    frames(5);
    EXPECT_EQ(inspector().inspection->pass, 2);
    click("inspector.follow");
    EXPECT_TRUE(inspector().follows);
    EXPECT_TRUE(wait_until([&] { return inspector().inspection->pass == 4; }));
}

TEST_F(PathInspector, ANewRequestIsInspectedAgain) {
    type(Key::i);
    inspect_pixel(1, {16, 14});
    const std::uint64_t generation = inspector().generation;
    state().panes[1].settings.render.method = Method::pr;
    EXPECT_TRUE(wait_until([&] { return inspector().generation > generation; }));
    EXPECT_EQ(inspector().inspection->method, Method::pr);
    const auto inspection = inspector().inspection;
    type(Key::digit1, true); // the second pane becomes the first
    frames(5);
    EXPECT_EQ(inspector().slot, pane(0).slot);
    EXPECT_EQ(inspector().inspection, inspection);
    state().panes[0].settings.render.method = Method::gpr;
    EXPECT_TRUE(wait_until([&] { return inspector().inspection->method == Method::gpr; }));
    EXPECT_EQ(inspector().generation, pane(0).generation);
    click("inspector.close");
    EXPECT_FALSE(inspector().active);
    frames(3);
    EXPECT_FALSE(has("inspector.direction"));
}

TEST_F(PathInspector, ThePixelOfAClosedPaneMovesToTheActivePane) {
    type(Key::i);
    inspect_pixel(1, {16, 14});
    type(Key::tab);
    ASSERT_EQ(state().active_pane, 0);
    type(Key::digit1, true);
    EXPECT_TRUE(wait_until([&] { return inspector().generation == pane(0).generation; }));
    EXPECT_EQ(inspector().inspection->method, Method::pt);
    EXPECT_EQ(inspector().inspection->pixel, glm::ivec2(16, 14));
}

TEST_F(PathInspector, ReplacedScenesAreDestroyed) {
    type(Key::i);
    inspect_pixel(1, {16, 14});
    ASSERT_TRUE(wait_until([&] { return state().space.surroundings != nullptr; }));
    type(Key::i);
    EXPECT_TRUE(lets_go_of_the_scene());
}

TEST_F(PathInspector, AClosedInspectorKeepsNoReplacedScene) {
    type(Key::i);
    {
        const Snapshot& s = *pane(1).snapshot;
        state().inspector.choose({pane(1).slot,
                                  {3, 4},
                                  1,
                                  std::make_shared<const PassOrigin>(PassOrigin{
                                      state().scene, s.camera, {48, 36}, s.settings, s.learned, s.generation})});
    }
    ASSERT_TRUE(wait_until([&] { return inspector().inspection != nullptr; }));
    type(Key::i);
    EXPECT_TRUE(lets_go_of_the_scene());
}

TEST_F(PathInspector, OpensTheSampleOfAMessage) {
    Message message{Message::Kind::note, "a bad sample", Message::Origin::viewer, {SampleChoice{1, {7, 9}, 1}}};
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
