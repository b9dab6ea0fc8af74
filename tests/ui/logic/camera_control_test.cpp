#include "ui/state/camera_control.h"

#include <cmath>
#include <random>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

/// Mitsuba's lookat: +z ahead, +y up, +x left.
glm::mat4 look_at(glm::vec3 origin, glm::vec3 target, glm::vec3 up) {
    const glm::vec3 forward = glm::normalize(target - origin);
    const glm::vec3 left = glm::normalize(glm::cross(up, forward));
    return {glm::vec4(left, 0), glm::vec4(glm::cross(forward, left), 0), glm::vec4(forward, 0),
            glm::vec4(origin, 1)};
}

Camera front_camera() {
    return {look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}), 40, FovAxis::x};
}

CameraControl control_of(const Camera& camera) {
    CameraControl control;
    control.set_home(camera, {0, 0, 0}, 2);
    return control;
}

void expect_near(glm::vec3 a, glm::vec3 b, float tolerance = 1e-4f) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

/// Projects a point to the picture. Inverts Camera::ray, whose directions are linear in the pixel at a fixed
/// depth.
glm::vec2 pixel_of(const Camera& camera, glm::vec3 point, glm::ivec2 size) {
    const auto local = [&](glm::vec3 v) { return glm::inverse(glm::mat3(camera.to_world)) * v; };
    const auto on_plane = [&](glm::vec2 pixel) {
        const glm::vec3 d = local(camera.ray(pixel, size).direction);
        return glm::vec2(d) / d.z;
    };
    const glm::vec3 d = local(point - glm::vec3(camera.to_world[3]));
    const glm::vec2 corner = on_plane({0, 0}), far_corner = on_plane(glm::vec2(size));
    return (glm::vec2(d) / d.z - corner) / (far_corner - corner) * glm::vec2(size);
}

TEST(CameraControl, TargetIsAtTheDistanceOfTheSceneCentre) {
    const CameraControl control = control_of(front_camera());
    EXPECT_NEAR(control.distance(), 5, 1e-5);
    expect_near(control.target(), {0, 0, 0});
    expect_near(control.forward(), {0, 0, -1});
}

TEST(CameraControl, OrbitKeepsTargetAndDistance) {
    CameraControl control = control_of(front_camera());
    std::mt19937 random(1);
    std::uniform_real_distribution<float> pixels(-300, 300);
    for (int i = 0; i < 2000; ++i)
        control.orbit({pixels(random), pixels(random)}, 400);
    expect_near(control.target(), {0, 0, 0}, 5e-3f);
    EXPECT_NEAR(control.distance(), 5, 1e-5);
    // The matrix remains a rotation, and the camera's left remains horizontal.
    const glm::mat3 axes(control.camera().to_world);
    EXPECT_NEAR(glm::determinant(axes), 1, 1e-4);
    EXPECT_NEAR(axes[0].y, 0, 1e-4);
    EXPECT_GT(axes[1].y, 0);
}

TEST(CameraControl, OrbitEqualsGlmRotations) {
    CameraControl control = control_of(front_camera());
    control.orbit({50, 0}, 400); // 50/400 of a half turn
    const float angle = glm::pi<float>() * 50 / 400;
    const glm::mat4 expected = glm::rotate(glm::mat4(1), -angle, {0, 1, 0}) * front_camera().to_world;
    for (int c = 0; c < 4; ++c)
        expect_near(glm::vec3(control.camera().to_world[c]), glm::vec3(expected[c]));

    control.orbit({0, 20}, 400);
    const glm::vec3 left(expected[0]);
    const glm::mat4 tilted = glm::rotate(glm::mat4(1), glm::pi<float>() * 20 / 400, left) * expected;
    for (int c = 0; c < 4; ++c)
        expect_near(glm::vec3(control.camera().to_world[c]), glm::vec3(tilted[c]));
}

TEST(CameraControl, OrbitMovesNearObjectsWithTheMouse) {
    const glm::ivec2 size(400, 300);
    const glm::vec3 in_front(0, 0, 1); // nearer than the target
    for (const glm::vec2 drag : {glm::vec2(30, 0), glm::vec2(0, 30)}) {
        CameraControl control = control_of(front_camera());
        const glm::vec2 before = pixel_of(control.camera(), in_front, size);
        control.orbit(drag, 300);
        const glm::vec2 moved = pixel_of(control.camera(), in_front, size) - before;
        EXPECT_GT(glm::dot(moved, drag), 0) << drag.x << ' ' << drag.y;
    }
}

TEST(CameraControl, OrbitStopsShortOfThePoles) {
    for (float direction : {1.0f, -1.0f}) {
        CameraControl control = control_of(front_camera());
        for (int i = 0; i < 50; ++i)
            control.orbit({0, direction * 100}, 400);
        EXPECT_LT(std::abs(control.forward().y), 0.9999f);
        EXPECT_GT(std::abs(control.forward().y), 0.99f);
        EXPECT_GT(control.camera().to_world[1].y, 0); // never upside down
    }
}

TEST(CameraControl, PanMovesTheTargetPlaneWithTheCursor) {
    const glm::ivec2 size(640, 360);
    for (const Camera& camera :
         {front_camera(), Camera{look_at({3, 2, 4}, {0.2f, 0, 0}, {0, 1, 0}), 60, FovAxis::y},
          Camera{glm::scale(look_at({3, 2, 4}, {0, 0, 0}, {0, 1, 0}), {-1, 1, 1}), 50, FovAxis::smaller}}) {
        CameraControl control = control_of(camera);
        const glm::vec2 from(200, 100), to(330, 250);
        const Ray ray = camera.ray(from, size);
        const glm::vec3 point =
            ray.origin + ray.direction * (control.distance() / glm::dot(ray.direction, control.forward()));
        control.pan(from, to, size);
        const glm::vec2 seen = pixel_of(control.camera(), point, size);
        EXPECT_NEAR(seen.x, to.x, 0.05f);
        EXPECT_NEAR(seen.y, to.y, 0.05f);
        EXPECT_NEAR(control.distance(), control_of(camera).distance(), 1e-5);
    }
}

Camera orthographic_camera() {
    Camera camera = front_camera();
    camera.to_world = glm::scale(camera.to_world, {3, 3, 1});
    camera.is_orthographic = true;
    return camera;
}

TEST(CameraControl, DollyScalesTheViewOfAnOrthographicCamera) {
    CameraControl control = control_of(orthographic_camera());
    control.dolly(0.5f);
    expect_near(control.position(), {0, 0, 5});
    EXPECT_NEAR(control.distance(), 5, 1e-5);
    const Ray corner = control.camera().ray({0, 0}, {100, 100});
    EXPECT_NEAR(std::abs(corner.origin.x), 1.5f, 1e-4);
    control.orbit({40, 20}, 300); // the size of the view stays
    EXPECT_NEAR(glm::length(glm::vec3(control.camera().to_world[0])), 1.5f, 1e-4);
    for (int i = 0; i < 1000; ++i)
        control.dolly(0.5f);
    EXPECT_GT(glm::length(glm::vec3(control.camera().to_world[0])), 1e-3f);
    control.go_home();
    control.orbit({40, 20}, 300);
    EXPECT_NEAR(glm::length(glm::vec3(control.camera().to_world[0])), 3, 1e-4);
}

TEST(CameraControl, OrthographicPanFollowsTheCursor) {
    CameraControl control = control_of(orthographic_camera());
    control.orbit({35, 18}, 300);
    const glm::ivec2 size(640, 360);
    const glm::vec2 from(200, 100), to(330, 250);
    const Ray before = control.camera().ray(from, size);
    control.pan(from, to, size);
    expect_near(control.camera().ray(to, size).origin, before.origin);
}

TEST(CameraControl, PanByThePictureWidthMovesByTheVisibleWidth) {
    // +x of a Mitsuba camera is to the left: dragging to the right moves the camera to its left.
    CameraControl control = control_of(front_camera());
    control.pan({0, 50}, {100, 50}, {100, 100});
    const float width = 2 * 5 * std::tan(glm::radians(20.0f));
    expect_near(control.position(), {-width, 0, 5}, 1e-3f);
    EXPECT_GT(glm::dot(control.position() - glm::vec3(0, 0, 5), glm::vec3(control.camera().to_world[0])), 0);
}

TEST(CameraControl, DollyKeepsTheTargetAndStopsBeforeIt) {
    CameraControl control = control_of(front_camera());
    control.dolly(0.5f);
    EXPECT_NEAR(control.distance(), 2.5f, 1e-5);
    expect_near(control.target(), {0, 0, 0});
    for (int i = 0; i < 100; ++i)
        control.dolly(0.8f);
    EXPECT_GT(control.distance(), 0);
    expect_near(control.forward(), {0, 0, -1});
    for (int i = 0; i < 200; ++i)
        control.dolly(2.0f);
    EXPECT_TRUE(std::isfinite(control.position().z));
}

TEST(CameraControl, FlyMovesAlongTheCamerasAxesInSceneRadii) {
    CameraControl control = control_of(front_camera());
    control.fly({1, 0, 0}); // left of a camera that looks along -z is -x
    expect_near(control.position(), {-2, 0, 5});
    control.fly({0, 1, 0});
    expect_near(control.position(), {-2, 2, 5});
    control.fly({0, 0, 1});
    expect_near(control.position(), {-2, 2, 3});
}

TEST(CameraControl, LookTurnsInPlace) {
    CameraControl control = control_of(front_camera());
    control.look(glm::half_pi<float>(), 0); // to the left
    expect_near(control.forward(), {-1, 0, 0});
    expect_near(control.position(), {0, 0, 5});
    control.look(0, 0.3f);
    EXPECT_NEAR(control.forward().y, std::sin(0.3f), 1e-4);
}

TEST(CameraControl, MirroredCameraStaysMirroredAndFollowsTheMouse) {
    Camera camera = front_camera();
    camera.to_world = glm::scale(camera.to_world, {-1, 1, 1});
    CameraControl control = control_of(camera);
    const glm::ivec2 size(400, 300);
    const glm::vec3 in_front(0, 0, 1);
    control.orbit({30, 0}, 300);
    EXPECT_LT(glm::determinant(glm::mat3(control.camera().to_world)), 0);
    EXPECT_GT(pixel_of(control.camera(), in_front, size).x, 200);
}

TEST(CameraControl, KeepsTheScaleOfTheMatrix) {
    Camera camera = front_camera();
    camera.to_world = glm::scale(camera.to_world, {2, 3, 0.5f});
    CameraControl control = control_of(camera);
    control.orbit({37, 21}, 300);
    control.look(0.2f, 0.1f);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(glm::length(glm::vec3(control.camera().to_world[c])),
                    glm::length(glm::vec3(camera.to_world[c])), 1e-4);
}

TEST(CameraControl, GoHomeRestoresTheFirstCamera) {
    CameraControl control = control_of(front_camera());
    control.orbit({100, 30}, 300);
    control.dolly(0.3f);
    control.fly({0.3f, 0.1f, 2});
    control.go_home();
    EXPECT_TRUE(control.camera() == front_camera());
    EXPECT_FLOAT_EQ(control.distance(), 5);
}

TEST(CameraControl, UpIsTheAxisNearestToTheCamerasUp) {
    // In a scene with z up, a sideways drag rotates about z.
    CameraControl control = control_of({look_at({0, -5, 1}, {0, 0, 0}, {0, 0, 1}), 40, FovAxis::x});
    const float height = control.position().z;
    control.orbit({80, 0}, 400);
    EXPECT_NEAR(control.position().z, height, 1e-4);
}

} // namespace
} // namespace tessera
