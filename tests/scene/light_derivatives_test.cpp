// Derivatives of points on lights by the random numbers of emitter sampling.
#include "render/scene/light.h"
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

using test::SceneBuilder;

/// Compares derivatives by both numbers with finite differences of `draw(u)`, up to 1e-3 of their length.
template <class Draw>
void expect_derivatives(const std::array<glm::vec3, 2>& derivatives, glm::vec2 u, Draw&& draw) {
    constexpr float step = 1e-3f;
    for (int axis = 0; axis < 2; ++axis) {
        glm::vec2 offset(0);
        offset[axis] = step;
        const glm::vec3 truth =
            (8.0f * (draw(u + offset) - draw(u - offset)) - (draw(u + 2.0f * offset) - draw(u - 2.0f * offset))) /
            (12 * step);
        const glm::vec3 derivative = derivatives[static_cast<std::size_t>(axis)];
        EXPECT_LT(glm::distance(derivative, truth), 1e-3f * glm::length(truth) + 1e-5f)
            << u.x << ' ' << u.y << " by number " << axis;
    }
}

/// Returns numbers at a distance from 0 and 1, so that finite differences stay in [0, 1].
glm::vec2 number(std::uint32_t i) {
    return 0.01f + 0.98f * Random(3, i, 0).draw_2d(0, Draw::direction);
}

TEST(LightDerivatives, OfTrianglesEqualFiniteDifferences) {
    LightTriangle t{};
    t.corner = {1, 2, 3};
    t.edge1 = {0.5f, 0.2f, -1};
    t.edge2 = {-0.3f, 0.8f, 0.1f};
    for (std::uint32_t i = 0; i < 200; ++i) {
        const glm::vec2 u = number(i) * glm::vec2(0.9f, 1);
        expect_derivatives(t.differentiate(u), u, [&](glm::vec2 at) {
            LightPoint p;
            t.sample(at, p);
            return p.position;
        });
    }
}

TEST(LightDerivatives, OfQuadricsEqualFiniteDifferences) {
    using Kind = Quadric::Kind;
    glm::mat4 skewed(1, 0.2f, 0, 0, 0.3f, 0.7f, 0.1f, 0, 0, -0.2f, 0.5f, 0, 1, 2, 3, 1), ball(0.8f);
    ball[3] = {1, 2, 3, 1};
    for (const Quadric& quadric : {Quadric(Kind::sphere, ball, false), Quadric(Kind::sphere, skewed, false),
                                   Quadric(Kind::disk, skewed, false), Quadric(Kind::cylinder, skewed, false)}) {
        const LightQuadric light{&quadric, Rgb(1), nullptr, 1, 0};
        const glm::vec3 receiver(0.2f, 0.5f, 1.2f);
        for (std::uint32_t i = 0; i < 200; ++i) {
            const glm::vec2 u = glm::vec2(0.05f) + 0.85f * number(i);
            LightPoint p;
            if (!light.sample(receiver, u, p))
                continue;
            expect_derivatives(light.differentiate(receiver, u), u, [&](glm::vec2 at) {
                light.sample(receiver, at, p);
                return p.position;
            });
        }
    }
}

/// Returns a rotated map of few cells with a sun. The number that selects one of both is rescaled and reused.
EnvironmentDescription sky_with_sun() {
    SceneBuilder b;
    std::vector<Rgb> pixels;
    for (int i = 0; i < 12; ++i)
        pixels.push_back(Rgb(0.2f + 0.3f * static_cast<float>(i % 5)));
    b.environment(pixels, 4, glm::mat3(0, 0, -1, 0.6f, 0.8f, 0, 0.8f, -0.6f, 0));
    b.sun({glm::normalize(glm::vec3(1, 2, 0.5f)), 0.3f, Rgb(20)});
    b.quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, b.diffuse(Rgb(0.5f)));
    b.camera({0, 1, 5}, {0, 1, 0}, 40);
    return b.build()->description().environment;
}

TEST(LightDerivatives, OfSkyAndSunEqualFiniteDifferences) {
    const Environment sky(sky_with_sun());
    for (std::uint32_t i = 0; i < 400; ++i) {
        const glm::vec2 cell = Random(4, i, 0).draw_2d(1, Draw::direction), u = number(i);
        const EnvironmentSample here = sky.sample(cell, u);
        const float apart = glm::distance(here.direction, sky.sample(cell, u + glm::vec2(0.004f, 0)).direction) +
                            glm::distance(here.direction, sky.sample(cell, u - glm::vec2(0.004f, 0)).direction);
        if (apart > 0.2f)
            continue; // near the border between sun and map
        expect_derivatives(sky.differentiate(cell, u).direction, u,
                           [&](glm::vec2 at) { return sky.sample(cell, at).direction; });
    }
}

/// The derivatives span an area, or solid angle, of chance / pdf [Suykens 2001, A.4].
TEST(LightDerivatives, SpanTheInverseOfThePdf) {
    SceneBuilder b;
    b.quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, b.diffuse(Rgb(0.5f)));
    b.quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, b.diffuse(Rgb(0)), b.light(Rgb(4, 2, 1)));
    b.quad({-1, 3, -1}, {1, 0, 0}, {0, 0, 1}, b.diffuse(Rgb(0)), b.light(Rgb(0.1f)));
    b.ball({-1, 1, 0.5f}, 0.4f, b.diffuse(Rgb(0)), b.light(Rgb(2)));
    b.point({{0, 1, 0}, Rgb(3)});
    b.environment({Rgb(1), Rgb(0.5f), Rgb(2), Rgb(0.3f)}, 2);
    b.camera({0, 1, 5}, {0, 1, 0}, 40);
    const auto scene = b.build();
    std::array<int, 5> count{};
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const Random random(5, i, 0);
        LightPoint p;
        if (!scene->lights().sample({0, 0, 0}, random, 1, p))
            continue;
        ++count[static_cast<std::size_t>(p.kind)];
        const LightDerivatives d = scene->lights().differentiate({0, 0, 0}, random, 1);
        const float area = glm::length(glm::cross(d.position[0], d.position[1]));
        if (p.kind == LightPoint::Kind::point) {
            EXPECT_EQ(area, 0);
            EXPECT_FLOAT_EQ(d.chance, p.pdf);
        } else if (p.kind == LightPoint::Kind::ball) {
            const glm::vec3 to = p.position;
            const float distance2 = glm::dot(to, to);
            const float angle = area * std::abs(glm::dot(to, p.normal)) / (distance2 * std::sqrt(distance2));
            EXPECT_NEAR(angle / d.chance * p.seen_from({0, 0, 0})->pdf_w, 1, 2e-3f);
        } else {
            EXPECT_NEAR(area / d.chance * p.pdf, 1, 1e-3f);
        }
    }
    EXPECT_GT(count[static_cast<std::size_t>(LightPoint::Kind::surface)], 100);
    EXPECT_GT(count[static_cast<std::size_t>(LightPoint::Kind::ball)], 50);
    EXPECT_GT(count[static_cast<std::size_t>(LightPoint::Kind::point)], 20);
    EXPECT_GT(count[static_cast<std::size_t>(LightPoint::Kind::environment)], 100);
}

} // namespace

} // namespace tessera
