#include "ui/panes/pane_parts.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

constexpr glm::ivec2 size(400, 300);

struct MouseTest : testing::Test {
    ViewerState state;
    Camera home;

    MouseTest() {
        home.to_world[3] = {0, 0, -5, 1};
        state.panes.resize(2);
        state.camera.set_home(home, {0, 0, 0}, 2);
    }
    void apply(PaneMouse mouse) { apply_mouse(mouse, state.display.view.place(size, size), size, size, state); }
    static PaneMouse drag() {
        PaneMouse mouse;
        mouse.previous = {200, 150};
        mouse.position = {230, 170};
        return mouse;
    }
};

TEST_F(MouseTest, LeftDragOrbits) {
    PaneMouse mouse = drag();
    mouse.left = true;
    apply(mouse);
    EXPECT_NEAR(state.camera.distance(), 5, 1e-4);
    EXPECT_LT(glm::length(state.camera.target()), 1e-3f);
    EXPECT_GT(glm::length(state.camera.position() - glm::vec3(0, 0, -5)), 0.1f);
}

TEST_F(MouseTest, MiddleAndShiftLeftDragPan) {
    PaneMouse middle = drag();
    middle.middle = true;
    apply(middle);
    const glm::vec3 moved = state.camera.position();
    EXPECT_GT(glm::length(state.camera.target()), 0.1f);
    EXPECT_LT(glm::length(state.camera.forward() - glm::vec3(0, 0, 1)), 1e-5f);
    state.camera.go_home();
    PaneMouse shifted = drag();
    shifted.left = shifted.shift = true;
    apply(shifted);
    EXPECT_EQ(state.camera.position(), moved);
}

TEST_F(MouseTest, WheelAndRightDragDolly) {
    PaneMouse wheel;
    wheel.wheel = 1;
    apply(wheel);
    EXPECT_LT(state.camera.distance(), 5);
    state.camera.go_home();
    PaneMouse right = drag();
    right.right = true;
    apply(right);
    EXPECT_GT(state.camera.distance(), 5); // downward moves away
    EXPECT_LT(glm::length(state.camera.target()), 1e-3f);
}

TEST_F(MouseTest, CtrlDragMovesThePictureNotTheCamera) {
    PaneMouse wheel;
    wheel.position = wheel.previous = {100, 100};
    wheel.wheel = 2;
    wheel.ctrl = true;
    apply(wheel);
    EXPECT_GT(state.display.view.zoom(), 1.4f);
    const ImageView zoomed = state.display.view;
    PaneMouse left = drag();
    left.left = left.ctrl = true;
    apply(left);
    EXPECT_NE(state.display.view, zoomed);
    EXPECT_TRUE(state.camera.camera() == home);
}

TEST_F(MouseTest, MovingWithoutAButtonDoesNothing) {
    apply(drag());
    EXPECT_TRUE(state.camera.camera() == home);
    EXPECT_EQ(state.display.view, ImageView());
}

} // namespace
} // namespace tessera
