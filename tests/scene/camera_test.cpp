// Cameras of all kinds: origins and directions of rays, and projections of points.
#include "render/scene/camera.h"

#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

constexpr glm::ivec2 size(40, 30);
constexpr glm::vec2 pixels[] = {{0, 0}, {40, 30}, {20, 15}, {3.5f, 27.25f}};
constexpr glm::vec2 lens_points[] = {{0, 0}, {1, 0}, {-0.5f, 0.7f}, {0, -1}};

glm::mat4 somewhere() {
    return glm::rotate(glm::translate(glm::mat4(1), {3, -2, 5}), 0.7f, glm::vec3(0.2f, 1, -0.4f));
}

Camera lens_camera() {
    Camera camera{somewhere(), 50, FovAxis::x};
    camera.aperture_radius = 0.3f;
    camera.focus_distance = 4;
    return camera;
}

Camera orthographic_camera() {
    Camera camera{glm::scale(somewhere(), {2, 2, 1})};
    camera.is_orthographic = true;
    return camera;
}

std::vector<Camera> all_kinds() {
    Camera telecentric = orthographic_camera(), shifted = lens_camera();
    telecentric.aperture_radius = 0.2f;
    telecentric.focus_distance = 3;
    shifted.principal_offset = {0.2f, -0.1f};
    return {{somewhere(), 50, FovAxis::y}, lens_camera(), orthographic_camera(), telecentric, shifted};
}

/// Transforms a point from world space to camera space.
glm::vec3 to_camera(const Camera& camera, glm::vec3 point) {
    return glm::vec3(glm::inverse(camera.to_world) * glm::vec4(point, 1));
}

TEST(Camera, LensPointsAgreeInTheFocalPlaneOnly) {
    for (const Camera& camera : all_kinds()) {
        if (camera.aperture_radius == 0)
            continue;
        for (const glm::vec2 pixel : pixels) {
            const auto at_depth = [&](glm::vec2 lens, float depth) {
                const Ray ray = camera.ray(pixel, size, lens);
                const float ahead = glm::dot(ray.direction, glm::vec3(camera.to_world[2]));
                return ray.origin + ray.direction * (depth / ahead);
            };
            const glm::vec3 sharp = at_depth({0, 0}, camera.focus_distance);
            for (const glm::vec2 lens : lens_points) {
                EXPECT_LT(glm::distance(at_depth(lens, camera.focus_distance), sharp), 1e-5f);
                // At twice the focus distance, the offset is that on the lens with the opposite sign.
                const glm::vec3 off =
                    at_depth(lens, 2 * camera.focus_distance) - at_depth({0, 0}, 2 * camera.focus_distance);
                const glm::vec3 start = camera.ray(pixel, size, lens).origin - camera.ray(pixel, size).origin;
                EXPECT_LT(glm::length(off + start), 2e-5f);
                const glm::vec3 on_lens = to_camera(camera, start + glm::vec3(camera.to_world[3]));
                EXPECT_LT(glm::distance(on_lens, glm::vec3(camera.aperture_radius * lens, 0)), 1e-5f);
            }
        }
    }
}

TEST(Camera, OrthographicRaysAreParallelAndTwoUnitsWide) {
    const Camera camera = orthographic_camera();
    for (const glm::vec2 pixel : pixels) {
        const Ray ray = camera.ray(pixel, size);
        EXPECT_LT(glm::distance(ray.direction, glm::normalize(glm::vec3(camera.to_world[2]))), 1e-6f);
        const glm::vec2 expected = (1.0f - 2.0f * pixel / glm::vec2(size)) * glm::vec2(1, 0.75f);
        EXPECT_LT(glm::distance(to_camera(camera, ray.origin), glm::vec3(expected, 0)), 1e-5f);
    }
    const PixelWidth width = Projection(camera, size).pixel_width();
    EXPECT_NEAR(width.at(1), 2 * 2.0f / 40, 1e-6f); // width of 2 units, scaled by 2
    EXPECT_EQ(width.at(1), width.at(1000));
}

TEST(Camera, PrincipalOffsetMovesThePictureByFractionsOfItsSize) {
    Camera camera{somewhere(), 50, FovAxis::x};
    const Ray plain = camera.ray({20, 15}, size);
    camera.principal_offset = {0.25f, -0.1f};
    EXPECT_LT(glm::distance(camera.ray({10, 18}, size).direction, plain.direction), 1e-6f);
}

TEST(Camera, ProjectionInvertsRays) {
    for (const Camera& camera : all_kinds()) {
        const Projection projection(camera, size);
        for (const glm::vec2 pixel : pixels)
            for (const glm::vec2 lens : lens_points) {
                const Ray ray = projection.ray(pixel, lens);
                EXPECT_NEAR(glm::length(ray.direction), 1, 1e-6f);
                const glm::vec4 seen = projection.project(ray.origin + 2.5f * ray.direction, lens);
                EXPECT_LT(glm::distance(glm::vec2(seen) / seen.w, pixel), 1e-3f);
                EXPECT_NEAR(seen.z, 2.5f * glm::dot(ray.direction, glm::vec3(camera.to_world[2])), 1e-5f);
                EXPECT_LT(projection.project(ray.origin - ray.direction, lens).z, 0);
            }
    }
}

} // namespace

} // namespace tessera
