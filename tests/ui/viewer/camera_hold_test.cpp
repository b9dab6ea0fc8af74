// A drag rotates the camera about the point under the mouse. A double click centres that point. A right click
// opens a menu. Bookmarks store views.
#include "render/run/first_hits.h"
#include "render/scene/scene.h"
#include "tests/ui/viewer_harness.h"
#include "ui/settings/settings_file.h"
#include "ui/state/actions.h"

#include <exception>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

struct CameraHold : testing::Test, ViewerHarness {
    CameraHold() { rest(2); }

    /// Returns a screen position over the second pane's picture, given as fractions of its area.
    glm::vec2 at(float x, float y) const {
        const ControlRect r = place("pane1.picture");
        return r.min + (r.max - r.min) * glm::vec2(x, y);
    }
    /// Returns the visible point there. The picture fills the pane's width.
    glm::vec3 seen(float x, float y) {
        const glm::ivec2 size = state().request_size();
        const ControlRect r = place("pane1.picture");
        const glm::vec2 pane = r.max - r.min;
        const float height = pane.x * static_cast<float>(size.y) / static_cast<float>(size.x);
        const glm::vec2 pixel = glm::vec2(x, ((y - 0.5f) * pane.y / height) + 0.5f) * glm::vec2(size);
        const Camera& camera = state().camera.camera();
        const float distance = first_hit_distance(*state().scene, camera, pixel, size);
        EXPECT_GT(distance, 0);
        const Ray ray = camera.ray(pixel, size);
        return ray.origin + distance * ray.direction;
    }
    glm::vec3 in_camera(glm::vec3 point) {
        return glm::vec3(glm::inverse(state().camera.camera().to_world) * glm::vec4(point, 1));
    }
};

TEST_F(CameraHold, ADragOrbitsThePointUnderTheMouse) {
    const glm::vec3 held = seen(0.3f, 0.55f), before = in_camera(held), from = state().camera.position();
    drag(at(0.3f, 0.55f), {60, 15});
    EXPECT_GT(glm::length(state().camera.position() - from), 0.05f);
    EXPECT_LT(glm::length(in_camera(held) - before), 0.02f * glm::length(before))
        << "the point stays in place on the screen";
    // Another drag orbits another point. A click adds no step to the history.
    rest(2);
    const Camera camera = state().camera.camera();
    const float distance = state().camera.distance();
    click(at(0.7f, 0.6f));
    EXPECT_TRUE(state().camera.camera() == camera);
    EXPECT_EQ(state().camera.distance(), distance);
    const glm::vec3 other = seen(0.7f, 0.6f), other_before = in_camera(other);
    drag(at(0.7f, 0.6f), {-40, 0});
    EXPECT_LT(glm::length(in_camera(other) - other_before), 0.02f * glm::length(other_before));
}

TEST_F(CameraHold, ADoubleClickCentresThePointUnderTheMouse) {
    const glm::vec3 point = seen(0.25f, 0.6f), from = state().camera.position();
    move_to(at(0.25f, 0.6f));
    for (int i = 0; i < 2; ++i) {
        press();
        release();
    }
    frames(2);
    EXPECT_EQ(state().camera.position(), from);
    const glm::vec3 way = glm::normalize(point - from);
    EXPECT_GT(glm::dot(way, state().camera.forward()), 0.9995f);
    EXPECT_NEAR(state().camera.distance(), glm::length(point - from), 0.03f * glm::length(point - from));
}

TEST_F(CameraHold, ARightClickOpensAMenuAndADragDoesNot) {
    const Camera before = state().camera.camera();
    drag(at(0.5f, 0.5f), {0, 40}, 1);
    EXPECT_FALSE(has("pane_menu/Wipe"));
    EXPECT_FALSE(state().camera.camera() == before);
    state().camera.go_home();
    rest(2);
    move_to(at(0.5f, 0.5f));
    press(1);
    release(1);
    frames(3);
    ASSERT_TRUE(has("pane_menu/Wipe"));
    save("pane-menu");
    click("pane_menu/Wipe");
    EXPECT_EQ(state().active().settings.comparison.kind, Comparison::Kind::wipe);
    EXPECT_TRUE(state().camera.camera() == before);
}

TEST_F(CameraHold, BookmarksAreRestoredAlsoFromSettings) {
    const Camera first = state().camera.camera();
    type(Key::f7, false, true);
    state().camera.orbit({40, 5}, 300);
    const Camera second = state().camera.camera();
    type(Key::f7, false, true);
    const std::string saved = settings_json(state());
    type(Key::f7);
    EXPECT_TRUE(state().camera.camera() == first) << "after the last comes the first";
    type(Key::f7, true);
    EXPECT_EQ(state().bookmarks.views.size(), 1u);
    apply_settings_json(state(), saved, "saved");
    ASSERT_EQ(state().bookmarks.views.size(), 2u);
    state().camera.go_home();
    type(Key::f7);
    type(Key::f7);
    const glm::vec3 expected(second.to_world[3]);
    EXPECT_LT(glm::length(state().camera.position() - expected), 1e-4f);
    EXPECT_THROW(apply_settings_json(state(), R"({"panes":[{}],"bookmarks":[{"target_distance":1}]})", "broken"),
                 std::exception);
}

TEST_F(CameraHold, ThePanelSetsTheFieldOfView) {
    const float before = state().camera.camera().fov;
    reveal("fov");
    click_at("fov", 0.9f);
    frames(2);
    EXPECT_GT(state().camera.camera().fov, before + 10);
    type(Key::home);
    EXPECT_EQ(state().camera.camera().fov, before);
}

} // namespace

} // namespace tessera::test
