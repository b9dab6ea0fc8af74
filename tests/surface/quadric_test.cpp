// Spheres, disks and cylinders: intersections, areas, normals, coordinates and derivatives.
#include "render/shapes/quadric.h"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

using Kind = Quadric::Kind;

constexpr double pi_d = std::numbers::pi;
constexpr Kind kinds[] = {Kind::sphere, Kind::disk, Kind::cylinder};

/// Returns a rotation with uneven scale and shear, optionally mirrored.
glm::mat4 skewed(bool mirrored = false) {
    glm::mat4 m = glm::translate(glm::mat4(1), glm::vec3(0.3f, -0.2f, 0.1f));
    m = glm::rotate(m, 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    m = glm::scale(m, glm::vec3(mirrored ? -1.5f : 1.5f, 0.4f, 0.8f));
    m[1] += 0.3f * m[0];
    return m;
}

glm::vec3 local_at(Kind kind, glm::vec2 uv) {
    const float phi = 2 * pi * (kind == Kind::disk ? uv.y : uv.x), theta = pi * uv.y;
    if (kind == Kind::sphere)
        return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    if (kind == Kind::disk)
        return {uv.x * std::cos(phi), uv.x * std::sin(phi), 0};
    return {std::cos(phi), std::sin(phi), uv.y};
}

glm::vec2 number(int i) {
    return Random(5, static_cast<std::uint32_t>(i), 0).draw_2d(0, Draw::direction);
}

TEST(Quadric, HitsAreTheIntersectionsWithTheLine) {
    for (const Kind kind : kinds) {
        const Quadric quadric(kind, skewed(), false);
        int counts[3] = {};
        for (int i = 0; i < 2000; ++i) {
            const glm::vec3 a = quadric.position(2.0f * glm::vec3(number(3 * i), number(3 * i + 1).x) - 0.5f);
            const glm::vec3 to = quadric.position(1.6f * glm::vec3(number(3 * i + 2), number(3 * i + 1).y) - 0.8f);
            const glm::vec3 direction = glm::normalize(to - a);
            std::array<Quadric::Hit, 2> hits;
            const int count = quadric.intersect(a, direction, hits);
            ++counts[count];
            for (int k = 0; k < count; ++k) {
                const glm::vec3 p = a + static_cast<float>(hits[k].distance) * direction;
                EXPECT_LT(glm::distance(p, quadric.position(hits[k].local)), 3e-6f);
                EXPECT_LT(glm::distance(hits[k].local, local_at(kind, quadric.uv(hits[k].local))), 2e-6f);
            }
            if (count == 2) {
                EXPECT_LE(hits[0].distance, hits[1].distance);
            }
        }
        EXPECT_GT(counts[kind == Kind::disk ? 1 : 2], 200) << "of kind " << static_cast<int>(kind);
        EXPECT_GT(counts[0], 20);
    }
}

/// The solutions that a line has are known in the shape's own space.
TEST(Quadric, MissesAreMisses) {
    const Quadric sphere(Kind::sphere, glm::mat4(1), false), tube(Kind::cylinder, glm::mat4(1), false);
    std::array<Quadric::Hit, 2> hits;
    EXPECT_EQ(sphere.intersect({-5, 0, 0.9999f}, {1, 0, 0}, hits), 2);
    EXPECT_EQ(sphere.intersect({-5, 0, 1.0001f}, {1, 0, 0}, hits), 0);
    EXPECT_EQ(tube.intersect({-5, 0, 0.5f}, {1, 0, 0}, hits), 2);
    EXPECT_EQ(tube.intersect({-5, 0, 1.0001f}, {1, 0, 0}, hits), 0);
    EXPECT_EQ(tube.intersect({0, 0, -5}, {0, 0, 1}, hits), 0) << "open at the ends";
    const glm::vec3 slope = glm::normalize(glm::vec3(1, 0, 1));
    EXPECT_EQ(tube.intersect({-1.5f, 0, 0}, slope, hits), 1) << "leaves through an end";
    EXPECT_NEAR(hits[0].distance, std::sqrt(0.5), 1e-6);
}

/// From a thousand diameters away, a float has 1e-4 of a diameter, and the hit's position on the sphere 1e-6.
TEST(Quadric, IsExactFromFarAway) {
    const Quadric sphere(Kind::sphere, glm::scale(glm::mat4(1), glm::vec3(1e-3f)), false);
    std::array<Quadric::Hit, 2> hits;
    ASSERT_EQ(sphere.intersect({2, 0, 5e-4f}, {-1, 0, 0}, hits), 2);
    EXPECT_NEAR(hits[0].distance, 2 - 1e-3 * std::sqrt(0.75), 1e-9);
    EXPECT_NEAR(hits[0].local.x, std::sqrt(0.75), 1e-5);
    EXPECT_NEAR(glm::length(hits[0].local), 1, 1e-6);
}

TEST(Quadric, AreasEqualTheClosedForms) {
    const glm::mat4 twice = glm::rotate(glm::scale(glm::mat4(1), glm::vec3(2)), 1.0f, glm::vec3(0.6f, 0, 0.8f));
    EXPECT_NEAR(Quadric(Kind::sphere, twice, false).area(), 16 * pi_d, 1e-4);
    EXPECT_NEAR(Quadric(Kind::disk, twice, false).area(), 4 * pi_d, 1e-4);
    EXPECT_NEAR(Quadric(Kind::cylinder, twice, false).area(), 8 * pi_d, 1e-4);
    // A prolate spheroid, an ellipse, and a cylinder stretched along its axis.
    const double e = std::sqrt(0.75);
    EXPECT_NEAR(Quadric(Kind::sphere, glm::scale(glm::mat4(1), glm::vec3(1, 1, 2)), false).area(),
                2 * pi_d * (1 + 2 / e * std::asin(e)), 5e-3);
    EXPECT_NEAR(Quadric(Kind::disk, glm::scale(glm::mat4(1), glm::vec3(3, 2, 7)), false).area(), 6 * pi_d, 1e-4);
    EXPECT_NEAR(Quadric(Kind::cylinder, glm::scale(glm::mat4(1), glm::vec3(1, 1, 5)), false).area(), 10 * pi_d,
                1e-4);
}

/// The mean of 1 / pdf over points that are uniform in the own space is the area.
TEST(Quadric, PdfsPerAreaIntegrateToOne) {
    for (const Kind kind : kinds)
        for (const bool mirrored : {false, true}) {
            const Quadric quadric(kind, skewed(mirrored), false);
            double sum = 0;
            constexpr int steps = 300;
            for (int i = 0; i < steps; ++i)
                for (int j = 0; j < steps; ++j) {
                    const glm::vec2 u = (glm::vec2(i, j) + 0.5f) / static_cast<float>(steps);
                    // Rows of equal area on the sphere.
                    const glm::vec2 uv(u.x, kind == Kind::sphere ? std::acos(1 - 2 * u.y) / pi : u.y);
                    sum += 1 / static_cast<double>(quadric.pdf_a(local_at(kind, uv)));
                }
            EXPECT_NEAR(sum / (steps * steps) / quadric.area(), 1, 2e-4);
        }
}

TEST(Quadric, DerivativesEqualFiniteDifferences) {
    constexpr float step = 1e-3f;
    for (const Kind kind : kinds)
        for (int i = 0; i < 100; ++i) {
            const glm::vec2 uv = 0.05f + 0.9f * number(i);
            const auto by = Quadric(kind, glm::mat4(1), false).derivatives(local_at(kind, uv));
            for (int axis = 0; axis < 2; ++axis) {
                glm::vec2 offset(0);
                offset[axis] = step;
                const glm::vec3 truth = (local_at(kind, uv + offset) - local_at(kind, uv - offset)) / (2 * step);
                EXPECT_LT(glm::distance(by[axis], truth), 2e-3f) << static_cast<int>(kind) << ' ' << axis;
            }
        }
    const auto at_pole = Quadric(Kind::sphere, glm::mat4(1), false).derivatives({0, 0, 1});
    EXPECT_GT(glm::length(at_pole[0]), 0) << "frames need a direction of u";
}

TEST(Quadric, NormalsArePerpendicularToBothDerivatives) {
    for (const Kind kind : kinds)
        for (const bool mirrored : {false, true})
            for (int i = 0; i < 50; ++i) {
                const Quadric quadric(kind, skewed(mirrored), false);
                const glm::vec3 local = local_at(kind, number(i)), n = quadric.normal(local);
                EXPECT_NEAR(glm::length(n), 1, 1e-5f);
                for (const glm::vec3 by : quadric.derivatives(local))
                    EXPECT_NEAR(glm::dot(n, glm::normalize(quadric.vector(by))), 0, 1e-5f);
            }
}

TEST(Quadric, BoundsHoldTheShapeTightly) {
    for (const Kind kind : kinds) {
        const Quadric quadric(kind, skewed(), false);
        const Quadric::Bounds box = quadric.bounds();
        glm::vec3 low(1e9f), high(-1e9f);
        for (int i = 0; i <= 200; ++i)
            for (int j = 0; j <= 200; ++j) {
                const glm::vec3 p = quadric.position(local_at(kind, glm::vec2(i, j) / 200.0f));
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(box.low[axis], low[axis]);
            EXPECT_GE(box.high[axis], high[axis]);
            EXPECT_NEAR(box.low[axis], low[axis], 1e-3f);
            EXPECT_NEAR(box.high[axis], high[axis], 1e-3f);
        }
    }
}

/// The hit that Mitsuba 3.9.1 returns for a ray.
struct MitsubaHit {
    Kind kind;
    glm::vec3 scale;
    bool flip_normals;
    glm::vec3 origin, direction; // any length
    glm::vec3 normal;
    glm::vec2 uv;
    glm::vec3 by_u, by_v;
};

TEST(Quadric, NormalsAndCoordinatesAreThoseOfMitsuba) {
    const glm::vec3 from(3, 2, 1.5f), side(3, 2, 0.4f), above(0.3f, 0.4f, 3);
    const MitsubaHit expected[] = {
        {Kind::sphere,
         {1, 1, 1},
         false,
         from,
         -from,
         {0.768221f, 0.512148f, 0.384111f},
         {0.0935836f, 0.374508f},
         {-3.21792f, 4.82688f, 0},
         {1.00405f, 0.669367f, -2.90059f}},
        {Kind::sphere,
         {-1, 1, 1},
         false,
         from,
         -from,
         {-0.768221f, -0.512148f, -0.384111f},
         {0.406416f, 0.374508f},
         {3.21792f, -4.82688f, 0},
         {1.00405f, 0.669367f, -2.90059f}},
        {Kind::sphere,
         {1, 1, -1},
         false,
         from,
         -from,
         {-0.768221f, -0.512148f, -0.384111f},
         {0.0935836f, 0.625492f},
         {-3.21792f, 4.82688f, 0},
         {-1.00405f, -0.669367f, 2.90059f}},
        {Kind::sphere,
         {-1, -1, -1},
         false,
         from,
         -from,
         {-0.768221f, -0.512148f, -0.384111f},
         {0.593584f, 0.625492f},
         {-3.21792f, 4.82688f, 0},
         {-1.00405f, -0.669367f, 2.90059f}},
        {Kind::disk,
         {1, 1, 1},
         false,
         above,
         {0, 0, -1},
         {0, 0, 1},
         {0.5f, 0.147584f},
         {0.6f, 0.8f, 0},
         {-2.51327f, 1.88496f, 0}},
        {Kind::disk,
         {-1, 1, 1},
         false,
         above,
         {0, 0, -1},
         {0, 0, 1},
         {0.5f, 0.352416f},
         {0.6f, 0.8f, 0},
         {2.51327f, -1.88496f, 0}},
        {Kind::disk,
         {1, 1, -1},
         false,
         above,
         {0, 0, -1},
         {0, 0, -1},
         {0.5f, 0.147584f},
         {0.6f, 0.8f, 0},
         {-2.51327f, 1.88496f, 0}},
        {Kind::disk,
         {1, 1, 1},
         true,
         above,
         {0, 0, -1},
         {0, 0, -1},
         {0.5f, 0.147584f},
         {0.6f, 0.8f, 0},
         {-2.51327f, 1.88496f, 0}},
        {Kind::disk,
         {1, 3, 2},
         false,
         above,
         {0, 0, -1},
         {0, 0, 1},
         {0.328295f, 0.0665624f},
         {0.913812f, 1.21842f, 0},
         {-0.837758f, 5.65487f, 0}},
        {Kind::cylinder,
         {1, 1, 1},
         false,
         side,
         {-3, -2, 0},
         {0.83205f, 0.5547f, 0},
         {0.0935835f, 0.4f},
         {-3.48528f, 5.22793f, 0},
         {0, 0, 1}},
        {Kind::cylinder,
         {-1, 1, 1},
         false,
         side,
         {-3, -2, 0},
         {0.83205f, 0.5547f, 0},
         {0.406416f, 0.4f},
         {3.48529f, -5.22793f, 0},
         {0, 0, 1}},
        {Kind::cylinder,
         {1, 1, 1},
         true,
         side,
         {-3, -2, 0},
         {-0.83205f, -0.5547f, 0},
         {0.0935835f, 0.4f},
         {-3.48528f, 5.22793f, 0},
         {0, 0, 1}},
    };
    for (const MitsubaHit& e : expected) {
        const Quadric quadric(e.kind, glm::scale(glm::mat4(1), e.scale), e.flip_normals);
        std::array<Quadric::Hit, 2> hits;
        ASSERT_GT(quadric.intersect(e.origin, e.direction, hits), 0);
        const glm::vec3 local = hits[0].local;
        EXPECT_LT(glm::distance(quadric.normal(local), e.normal), 1e-5f) << static_cast<int>(e.kind);
        EXPECT_LT(glm::distance(quadric.uv(local), e.uv), 1e-5f) << static_cast<int>(e.kind);
        const auto by = quadric.derivatives(local);
        EXPECT_LT(glm::distance(quadric.vector(by[0]), e.by_u), 1e-4f) << static_cast<int>(e.kind);
        EXPECT_LT(glm::distance(quadric.vector(by[1]), e.by_v), 1e-4f) << static_cast<int>(e.kind);
    }
}

TEST(Quadric, NeedsAnInverseExceptAlongTheAxisOfADisk) {
    const glm::mat4 flat = glm::scale(glm::mat4(1), glm::vec3(2, 1, 0));
    EXPECT_THROW(Quadric(Kind::sphere, flat, false), std::runtime_error);
    EXPECT_THROW(Quadric(Kind::cylinder, flat, false), std::runtime_error);
    EXPECT_NEAR(Quadric(Kind::disk, flat, false).area(), 2 * pi_d, 1e-5);
    EXPECT_THROW(Quadric(Kind::disk, glm::scale(glm::mat4(1), glm::vec3(0, 1, 1)), false), std::runtime_error);
    EXPECT_THROW(Quadric(Kind::sphere, glm::mat4(INFINITY), false), std::runtime_error);
}

} // namespace

} // namespace tessera
