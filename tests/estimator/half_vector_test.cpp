// Half-vector copies between vertices: the copy inverts itself, and its Jacobian is the derivative, theory (15).
#include "render/paths/shift.h"
#include "tests/surface/bsdf_cases.h"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

Vertex vertex(const Bsdf& bsdf, glm::vec3 to_previous, glm::vec3 normal = {0, 0, 1}) {
    Vertex v{};
    v.frame = Frame(glm::normalize(normal));
    v.bsdf = bsdf;
    v.to_previous = glm::normalize(to_previous);
    return v;
}

Bsdf rough_glass(float eta, float alpha = 0.5f) {
    return {RoughDielectric{{MicrofacetDistribution::ggx, alpha}, eta}};
}

/// Returns the solid angle at the offset over that at the base, by finite differences.
double measured_jacobian(const Vertex& base, glm::vec3 to_next, const Vertex& offset) {
    const Frame around(to_next);
    const float step = 5e-4f;
    const auto moved = [&](float x, float y) {
        const glm::vec3 d = glm::normalize(to_next + x * around.tangent + y * around.bitangent);
        return glm::dvec3(copy_half_vector(base, d, offset).value().to_next);
    };
    const glm::dvec3 slope_x = (moved(step, 0) - moved(-step, 0)) / (2.0 * step);
    const glm::dvec3 slope_y = (moved(0, step) - moved(0, -step)) / (2.0 * step);
    return glm::length(glm::cross(slope_x, slope_y));
}

struct Tally {
    int copied = 0, transmitted = 0, reflected = 0;
};

/// Copies many scatters of `a` to `b` and back. The views and normals of both vertices differ a little.
Tally copy_there_and_back(const Bsdf& a, const Bsdf& b, float side) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> uniform(0, 0x1.fffffep-1f);
    const auto next = [&] { return uniform(engine); };
    Tally tally;
    for (int i = 0; i < 400; ++i) {
        const glm::vec3 view(next() - 0.5f, next() - 0.5f, side * (0.3f + next()));
        const glm::vec3 other = view + 0.2f * glm::vec3(next() - 0.5f, next() - 0.5f, next() - 0.5f);
        const glm::vec3 bend(0.2f * (next() - 0.5f), 0.2f * (next() - 0.5f), 1);
        const Vertex base = vertex(a, view), offset = vertex(b, other, bend);
        const float lobe = next(), u = next();
        const auto s = a.sample(base.to_previous, lobe, {u, next()});
        if (!s)
            continue;
        const auto there = copy_half_vector(base, s->to_next, offset);
        if (!there)
            continue;
        const bool transmits = s->scatter == Scatter::transmit;
        EXPECT_EQ(there->to_next.z * offset.to_previous.z < 0, transmits);
        ++tally.copied;
        ++(transmits ? tally.transmitted : tally.reflected);
        const auto back = copy_half_vector(offset, there->to_next, base);
        if (!back) {
            ADD_FAILURE() << "the copy back failed";
            continue;
        }
        EXPECT_LT(glm::distance(back->to_next, s->to_next), 2e-4f);
        EXPECT_NEAR(there->jacobian * back->jacobian, 1, 1e-3f);
        // Near total reflection the derivative is unbounded, and finite differences are inaccurate.
        if (there->jacobian < 5 && back->jacobian < 5 && std::abs(there->to_next.z) > 0.1f &&
            std::abs(s->to_next.z) > 0.1f) {
            EXPECT_NEAR(measured_jacobian(base, s->to_next, offset) / there->jacobian, 1, 1.5e-3); // rounding
        }
    }
    return tally;
}

TEST(HalfVector, IsInvertibleWithItsJacobian) {
    for (const float side : {1.0f, -1.0f}) {
        const Tally same = copy_there_and_back(rough_glass(1.5f), rough_glass(1.5f), side);
        EXPECT_GT(same.transmitted, 50);
        EXPECT_GT(same.reflected, 10);
        EXPECT_GT(copy_there_and_back(rough_glass(1.5f), rough_glass(1.33f), side).transmitted, 50);
        EXPECT_GT(copy_there_and_back(rough_glass(1.33f), rough_glass(1 / 1.2f), side).transmitted, 50);
    }
    const Bsdf metal{RoughConductor{{MicrofacetDistribution::ggx, 0.4f}}};
    EXPECT_GT(copy_there_and_back(metal, rough_glass(1.5f), 1).reflected, 100);
    EXPECT_EQ(copy_there_and_back(rough_glass(1.5f), metal, 1).transmitted, 0);
}

/// Transmission through a thin sheet is a mirrored reflection. It cannot be copied to refracting glass, or back.
TEST(HalfVector, IsCopiedThroughThinSheets) {
    const Bsdf sheet = resolved(thin_principled(0.5f, 1));
    for (const float side : {1.0f, -1.0f}) {
        const Tally same = copy_there_and_back(sheet, sheet, side);
        EXPECT_GT(same.transmitted, 50);
        EXPECT_GT(same.reflected, 50);
        EXPECT_EQ(copy_there_and_back(sheet, rough_glass(1.5f), side).transmitted, 0);
        EXPECT_EQ(copy_there_and_back(rough_glass(1.5f), sheet, side).transmitted, 0);
    }
    const Bsdf layer{UncommonBsdf{MediumLayer{Rgb(0.8f), Rgb(1), 0.5f, true}}};
    EXPECT_GT(copy_there_and_back(layer, sheet, 1).transmitted, 50);
    // A blend of glass and sheet also transmits to directions that glass alone cannot.
    const Bsdf both = resolved(blend(shared(glass(0.4f)), shared(thin_principled(0, 2)), 0.5f));
    EXPECT_GT(copy_there_and_back(both, both, 1).transmitted, 50);
    EXPECT_GT(copy_there_and_back(both, both, -1).transmitted, 50);
}

TEST(HalfVector, CopiesTransmissionsToTransmissionsOnly) {
    // A refraction into the glass has no copy at an offset that is inside.
    const Vertex base = vertex(rough_glass(1.5f), {0.1f, 0, 1}), inside = vertex(rough_glass(1.5f), {1, 0, -0.5f});
    const auto straight = refract(base.to_previous, {0, 0, 1}, 1.5f);
    ASSERT_TRUE(straight);
    EXPECT_TRUE(copy_half_vector(base, *straight, base));
    EXPECT_FALSE(copy_half_vector(base, *straight, inside));
    EXPECT_FALSE(copy_half_vector(base, *straight, vertex({Diffuse{Rgb(0.5f)}}, {0, 0, 1})));
    // A reflection whose copy would leave below the surface.
    const glm::vec3 half = glm::normalize(glm::vec3(0.6f, 0, 1));
    EXPECT_FALSE(
        copy_half_vector(vertex(rough_glass(1.5f), half), half, vertex(rough_glass(1.5f), {-1, 0, 0.3f})));
}

/// Tangents of frames can differ by any angle between nearly equal normals. Copied directions must not depend on
/// that.
TEST(HalfVector, TurnsWithTheNormalOnly) {
    const Bsdf metal{RoughConductor{{MicrofacetDistribution::ggx, 0.4f}}};
    for (const glm::vec3 normal : {glm::vec3(1, 0, 0.01f), glm::vec3(1, 1, 0.01f), glm::vec3(0, 1, 0.01f),
                                   glm::vec3(0.3f, 0.2f, -1), glm::vec3(-1, 0, 0.01f)}) {
        Vertex base = vertex(metal, {0, 0, 1}, normal);
        Vertex offset = vertex(metal, {0, 0, 1}, normal * glm::vec3(1, 1, -1));
        if (normal.z < -0.5f)
            offset.frame = Frame(glm::normalize(normal + glm::vec3(0.02f, 0, 0)));
        const glm::vec3 view = glm::normalize(glm::normalize(normal) + glm::vec3(0.2f, -0.3f, 0.25f));
        base.to_previous = base.to_local(view);
        offset.to_previous = offset.to_local(view);
        const glm::vec3 next = glm::normalize(glm::normalize(normal) + glm::vec3(-0.3f, 0.2f, -0.1f));
        const auto there = copy_half_vector(base, base.to_local(next), offset);
        ASSERT_TRUE(there);
        EXPECT_LT(glm::distance(offset.to_world(there->to_next), next), 0.09f); // 5 degrees
        const auto back = copy_half_vector(offset, there->to_next, base);
        ASSERT_TRUE(back);
        EXPECT_LT(glm::distance(base.to_world(back->to_next), next), 2e-4f);
        EXPECT_NEAR(there->jacobian * back->jacobian, 1, 1e-3f);
    }
}

} // namespace

} // namespace tessera::test
