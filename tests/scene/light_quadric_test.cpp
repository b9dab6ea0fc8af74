// Emitter sampling of spheres, disks and cylinders: irradiance against closed forms and against rays, and equal
// pdfs for sampling a point and for hitting it.
#include "render/paths/tracer.h"
#include "render/scene/light.h"
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

using Kind = Quadric::Kind;

glm::mat4 skewed() {
    glm::mat4 m = glm::translate(glm::mat4(1), glm::vec3(0.3f, 2, 0.1f));
    m = glm::rotate(m, 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    m = glm::scale(m, glm::vec3(0.9f, 0.4f, 0.6f));
    m[1] += 0.3f * m[0];
    return m;
}

/// Returns a scene with one emitting quadric of radiance 2, or of a chequered radiance with that mean.
std::shared_ptr<const Scene> lamp(const Quadric& quadric, bool textured = false) {
    SceneBuilder b;
    Texture radiance{Rgb(2)};
    if (textured)
        radiance.kind = CheckerboardTexture{Rgb(3), Rgb(1)};
    b.quadric(quadric, b.diffuse(Rgb(0)), b.light(radiance));
    b.camera({0, 1, 5}, {0, 1, 0}, 40);
    return b.build();
}

glm::vec2 stratum(int i, int side) {
    return (glm::vec2(i % side, i / side) + 0.5f) / static_cast<float>(side);
}

/// Returns the irradiance at a point by emitter sampling, without occlusion by other surfaces.
double sampled_irradiance(const Scene& scene, glm::vec3 at, glm::vec3 normal, int samples = 400000) {
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
        LightPoint light;
        if (!scene.lights().sample(at, Random(3, 1, static_cast<std::uint32_t>(i)), 0, light))
            continue;
        if (const auto seen = light.seen_from(at))
            sum += static_cast<double>(std::max(glm::dot(seen->direction, normal), 0.0f) *
                                       luminance(seen->radiance) / seen->pdf_w);
    }
    return sum / samples;
}

/// Returns the irradiance by rays of the cosine-weighted hemisphere, which need no pdf of lights.
double traced_irradiance(const Scene& scene, glm::vec3 at, glm::vec3 normal) {
    constexpr int side = 900;
    const Frame frame(normal);
    double sum = 0;
    for (int i = 0; i < side * side; ++i) {
        const Ray ray{at, frame.to_world(sample_cosine_hemisphere(stratum(i, side)))};
        Hit hit;
        if (!scene.intersector().closest(ray, hit))
            continue;
        Vertex v;
        make_vertex(scene, hit, ray, v);
        sum += static_cast<double>(luminance(v.light_toward(-ray.direction).radiance));
    }
    return sum / (side * side) * static_cast<double>(pi);
}

glm::mat4 ball(glm::vec3 center, float radius) {
    return glm::scale(glm::translate(glm::mat4(1), center), glm::vec3(radius));
}

/// A sphere above the horizon gives the irradiance pi L (r / d)^2 cos.
TEST(LightQuadric, SphereGivesTheIrradianceOfTheClosedForm) {
    const auto scene = lamp(Quadric(Kind::sphere, ball({0, 2, 0}, 0.5f), false));
    for (const glm::vec3 at : {glm::vec3(0, 0, 0), glm::vec3(1, 0.5f, 0.3f), glm::vec3(0, 1.4f, 0),
                               glm::vec3(0, 1.4999f, 0), glm::vec3(40, 0, -30)}) {
        const glm::vec3 d = glm::vec3(0, 2, 0) - at;
        const double square = static_cast<double>(glm::dot(d, d));
        const double expected =
            static_cast<double>(pi) * 2 * 0.25 / square * static_cast<double>(d.y) / std::sqrt(square);
        EXPECT_NEAR(sampled_irradiance(*scene, at, {0, 1, 0}) / expected, 1, 3e-3) << at.x << ' ' << at.y;
    }
}

/// Each sample of the cone of a distant sphere has nearly the same value: sampling by area would have a relative
/// deviation of 0.58 and more, as half of the points face away.
TEST(LightQuadric, SamplesOfTheConeHaveEqualValues) {
    const auto scene = lamp(Quadric(Kind::sphere, ball({0, 2, 0}, 0.1f), false));
    for (std::uint32_t i = 0; i < 1000; ++i) {
        LightPoint light;
        ASSERT_TRUE(scene->lights().sample({0, 0, 0}, Random(3, 1, i), 0, light));
        const auto seen = light.seen_from({0, 0, 0});
        ASSERT_TRUE(seen);
        EXPECT_NEAR(1 / seen->pdf_w, 2 * double(pi) * (1 - std::sqrt(1 - 0.0025)), 1e-5);
        EXPECT_GT(seen->direction.y, std::sqrt(1 - 0.0025f) - 1e-5f);
    }
}

/// Inside of a sphere that emits inward, the irradiance is pi L everywhere.
TEST(LightQuadric, SphereWithFrontInside) {
    for (const bool is_mirrored : {false, true}) {
        glm::mat4 m = ball({0, 2, 0}, 0.5f);
        m[0] *= is_mirrored ? -1.0f : 1.0f;
        const auto scene = lamp(Quadric(Kind::sphere, m, !is_mirrored));
        for (const glm::vec3 at : {glm::vec3(0, 2, 0), glm::vec3(0.2f, 2.2f, 0.1f)})
            EXPECT_NEAR(sampled_irradiance(*scene, at, {0, 1, 0}) / (2 * double(pi)), 1, 0.02);
    }
}

struct Lamp {
    std::string name;
    Quadric quadric;
};

/// All of them emit toward points near the origin, and none hides any part of itself from there.
std::vector<Lamp> lamps() {
    const glm::mat4 around(3, 0, 0, 0, 0.5f, 0, 3, 0, 0, 4, 0, 0, 0, -1, 0, 1); // from y = -1 to 3
    return {{"sphere", Quadric(Kind::sphere, ball({0.3f, 2, 0}, 0.6f), false)},
            {"ellipsoid", Quadric(Kind::sphere, skewed(), false)},
            {"ellipsoid inside", Quadric(Kind::sphere, glm::scale(skewed(), glm::vec3(9)), true)},
            {"disk", Quadric(Kind::disk, skewed(), false)},
            {"cylinder", Quadric(Kind::cylinder, skewed(), false)},
            {"cylinder inside", Quadric(Kind::cylinder, around, true)}};
}

TEST(LightQuadric, EmitterSamplingAgreesWithRays) {
    const glm::vec3 at(0.2f, 0, 0.1f), normal = glm::normalize(glm::vec3(0.2f, 1, 0.1f));
    for (const Lamp& l : lamps())
        for (const bool textured : {false, true}) {
            const auto scene = lamp(l.quadric, textured);
            const double expected = traced_irradiance(*scene, at, normal);
            EXPECT_GT(expected, 0.02) << l.name;
            EXPECT_NEAR(sampled_irradiance(*scene, at, normal) / expected, 1, 0.01) << l.name << textured;
        }
}

/// A path that hits a sampled point must find there the pdf and radiance of the sample.
TEST(LightQuadric, HitsHaveThePdfOfSamples) {
    const glm::vec3 at(0.2f, 0, 0.1f);
    for (const Lamp& l : lamps())
        for (const bool textured : {false, true}) {
            const auto scene = lamp(l.quadric, textured);
            int compared = 0;
            for (std::uint32_t i = 0; i < 500; ++i) {
                LightPoint light;
                if (!scene->lights().sample(at, Random(4, 1, i), 0, light))
                    continue;
                const auto seen = light.seen_from(at);
                Hit hit;
                if (!seen || !scene->intersector().closest({at, seen->direction}, hit) ||
                    std::abs(hit.distance - glm::distance(at, light.position)) > 1e-4f)
                    continue;
                Vertex v;
                make_vertex(*scene, hit, {at, seen->direction}, v);
                const auto met = v.light_toward(-seen->direction).seen_from(at);
                const float cosine = -glm::dot(seen->direction, light.normal);
                if (!met || cosine < 0.05f) // rounding matters at the rim
                    continue;
                ++compared;
                EXPECT_NEAR(met->pdf_w / seen->pdf_w, 1, 1e-3f) << l.name;
                EXPECT_NEAR(met->fixed_pdf_w / seen->fixed_pdf_w, 1, 1e-3f / cosine) << l.name;
                EXPECT_LT(glm::distance(v.geometric_normal, light.normal), 1e-3f) << l.name;
                EXPECT_LT(glm::distance(met->radiance, seen->radiance), 1e-5f) << l.name << textured;
            }
            EXPECT_GT(compared, 50) << l.name;
        }
}

/// The pdf of a cone integrates to 1 over the directions whose rays hit the sphere.
TEST(LightQuadric, PdfOfAConeIntegratesToOne) {
    const auto scene = lamp(Quadric(Kind::sphere, ball({0.3f, 2, 0}, 1.2f), false));
    const glm::vec3 at(0.2f, 0.4f, 0.1f);
    constexpr int side = 600;
    double sum = 0;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 u = stratum(i, side), sc = sin_cos_of_turns(u.y);
        const float z = 1 - 2 * u.x, sine = std::sqrt(1 - z * z);
        const Ray ray{at, {sine * sc.y, sine * sc.x, z}};
        Hit hit;
        if (!scene->intersector().closest(ray, hit))
            continue;
        Vertex v;
        make_vertex(*scene, hit, ray, v);
        const auto met = v.light_toward(-ray.direction).seen_from(at);
        ASSERT_TRUE(met);
        sum += static_cast<double>(met->pdf_w);
    }
    EXPECT_NEAR(sum / (side * side) * 4 * static_cast<double>(pi), 1, 3e-3);
}

TEST(LightQuadric, LightsAreChosenByPower) {
    SceneBuilder b;
    const int black = b.diffuse(Rgb(0));
    b.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, black, b.light(Rgb(1)));
    b.ball({0, 5, 0}, 0.5f, black, b.light(Rgb(1))); // area pi
    b.ball({0, 8, 0}, 0.5f, black, b.light(Rgb(0)));
    const auto scene = b.build();
    const LightTable table(scene->description(), scene->radius());
    EXPECT_EQ(table.size(), 3u); // two triangles and a sphere
    EXPECT_NEAR(table.powers()[1] / table.powers()[0], double(pi), 1e-5);
    EXPECT_NEAR(table.probability_of(*scene->shapes()[1].quadric, 1), double(pi) / (1 + double(pi)), 1e-6);
}

/// The rays that find no light by its bounding box must not meet the sphere.
TEST(LightQuadric, MayBeHitWhereRaysHitIt) {
    const auto scene = lamp(Quadric(Kind::sphere, skewed(), false));
    int hits = 0, spared = 0;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const glm::vec2 u = Random(9, i, 0).draw_2d(0, Draw::direction);
        const Ray ray{{0.2f, 0, 0.1f}, Frame(glm::vec3(0, 1, 0)).to_world(sample_cosine_hemisphere(u))};
        Hit hit;
        const bool met = scene->intersector().closest(ray, hit);
        hits += met;
        spared += !scene->lights().may_be_hit(ray);
        EXPECT_TRUE(!met || scene->lights().may_be_hit(ray));
    }
    EXPECT_GT(hits, 200);
    EXPECT_GT(spared, 1000);
}

} // namespace

} // namespace tessera::test
