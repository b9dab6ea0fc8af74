// All methods below a sphere light, against the closed form of the irradiance. judge_test.cpp compares quadrics
// with the naive path tracer.
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"
#include "tests/support/z_scores.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(9, 6);
const glm::vec3 center(0.2f, 0.7f, -0.1f);
constexpr float radius = 0.45f;
const Rgb reflectance(0.6f, 0.5f, 0.4f), radiance(3, 2, 1);

/// An orthographic view of 3 x 2 units of a floor, between the floor and the sphere.
std::shared_ptr<const Scene> floor_below_a_sphere() {
    SceneBuilder b;
    b.quad({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}, b.diffuse(reflectance));
    b.ball(center, radius, b.diffuse(Rgb(0)), b.light(Texture(radiance)));
    Camera camera{look_at({0, 0.2f, 0}, {0, 0, 0}, {0, 0, -1})};
    camera.to_world[0] *= 1.5f;
    camera.to_world[1] *= 1.5f;
    camera.is_orthographic = true;
    b.camera(camera);
    return b.build();
}

/// Returns the means over pixels of rho L (r / d)^2 cos, where the sphere is above the horizon.
RgbImage closed_form(const Scene& scene) {
    constexpr int steps = 24;
    RgbImage image(size.x, size.y);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            double sum = 0;
            for (int i = 0; i < steps * steps; ++i) {
                const glm::vec2 inside = (glm::vec2(i % steps, i / steps) + 0.5f) / static_cast<float>(steps);
                const Ray ray = scene.camera().ray(glm::vec2(x, y) + inside, size, {});
                const glm::vec3 at = ray.origin + ray.direction * (-ray.origin.y / ray.direction.y);
                const glm::dvec3 d = glm::dvec3(center - at);
                sum += double(radius) * double(radius) / glm::dot(d, d) * d.y / glm::length(d);
            }
            image(x, y) = reflectance * radiance * static_cast<float>(sum / (steps * steps));
        }
    return image;
}

TEST(RoundLamps, AllMethodsGiveTheClosedFormBelowASphere) {
    const auto scene = floor_below_a_sphere();
    const Measured truth{closed_form(*scene), RgbImage(size.x, size.y)};
    struct Case {
        std::string name;
        Method method;
        int tile;
        ShiftKind shift;
    };
    for (const Case& c :
         {Case{"pt", Method::pt, 1, ShiftKind::half_vector}, Case{"pr", Method::pr, 4, ShiftKind::half_vector},
          Case{"pr reconnection", Method::pr, 3, ShiftKind::reconnection},
          Case{"gpt", Method::gpt, 1, ShiftKind::half_vector}, Case{"gpr", Method::gpr, 6, ShiftKind::half_vector},
          Case{"gpr replay", Method::gpr, 4, ShiftKind::replay}}) {
        RenderSettings settings;
        settings.method = c.method;
        settings.tile = c.tile;
        settings.shift = c.shift;
        settings.max_depth = 2;
        settings.adapt_tile = false;
        settings.basis = Basis::none;
        settings.path_guiding = Guiding::off;
        struct Named {
            std::string name;
            ZResult z;
        };
        const auto tests = tests_by_enough_runs(7, 64, [&](std::uint64_t seed, int runs) {
            settings.seed = seed;
            const MethodMeasured m = measure(scene, size, settings, runs, 8, {});
            std::vector<Named> all{{"primal", z_test(m.primal, truth)}};
            if (has_gradients(c.method)) {
                all.push_back({"dx", z_test(m.dx, difference_x(truth))});
                all.push_back({"dy", z_test(m.dy, difference_y(truth))});
            }
            return all;
        });
        for (const Named& test : tests)
            EXPECT_TRUE(test.z.passes()) << c.name << ' ' << test.name << ": " << test.z.to_string();
    }
}

} // namespace

} // namespace tessera::test
