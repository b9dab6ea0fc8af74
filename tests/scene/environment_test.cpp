// Environment maps and suns: sampling, pdfs per solid angle, flux and orientation.
#include "render/sampling/sampling.h"
#include "render/scene/environment.h"
#include "render/surface/texture.h"

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

/// Returns an uneven map with black rows and one very bright pixel.
EnvironmentDescription uneven(int width, int height) {
    Bitmap bitmap;
    bitmap.width = width;
    bitmap.height = height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            bitmap.floats.push_back(y < height / 3 ? Rgb(0) : Rgb(0.1f * float(x % 5), 0.5f, 0.2f * float(y % 3)));
    bitmap.floats[bitmap.floats.size() * 2 / 3] = Rgb(300, 200, 100);
    EnvironmentDescription description;
    description.map = {std::make_shared<const Bitmap>(bitmap), 2,
                       glm::mat3(0, 0, -1, 0.6f, 0.8f, 0, 0.8f, -0.6f, 0)};
    return description;
}

glm::vec3 uniform_direction(glm::vec2 u) {
    const float z = 1 - 2 * u.x, r = std::sqrt(1 - z * z);
    return {r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y), z};
}

class Environments
    : public testing::TestWithParam<std::pair<const char*, std::function<EnvironmentDescription()>>> {
protected:
    Environment environment{GetParam().second()}; // constructed only for tests that run
    std::mt19937 engine{7};
    glm::vec2 random() {
        std::uniform_real_distribution<float> uniform(0, 0x1.fffffep-1f);
        const float x = uniform(engine);
        return {x, uniform(engine)};
    }
};

TEST_P(Environments, PdfIntegratesToOneAndFluxToTheLuminance) {
    // The grid over the sphere is stratified.
    constexpr int steps = 2000;
    double pdf = 0, flux = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const glm::vec3 d = uniform_direction((glm::vec2(i, j) + random()) / float(steps));
            pdf += environment.pdf_w(d);
            flux += luminance(environment.radiance(d));
            if (environment.pdf_w(d) <= 0) {
                ASSERT_TRUE(is_black(environment.radiance(d))); // otherwise sampling would lose this radiance
            }
        }
    const double cell = 4 * pi / (double(steps) * steps);
    EXPECT_NEAR(pdf * cell, 1, 0.01);
    EXPECT_NEAR(flux * cell, environment.flux(), 0.01 * environment.flux());
}

TEST_P(Environments, SamplesFollowThePdf) {
    // The mean direction of the samples must equal the integral of direction times pdf.
    constexpr int samples = 400000;
    glm::dvec3 mean(0), expected(0);
    int mismatches = 0;
    for (int i = 0; i < samples; ++i) {
        const EnvironmentSample s = environment.sample(random(), random());
        ASSERT_NEAR(glm::length(s.direction), 1, 1e-5f);
        ASSERT_GT(s.pdf_w, 0);
        mismatches += std::abs(environment.pdf_w(s.direction) / s.pdf_w - 1) > 1e-5f;
        mean += glm::dvec3(s.direction) / double(samples);
    }
    EXPECT_LT(mismatches, samples / 1000); // rounding at the edges of cells
    constexpr int steps = 2000;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const glm::vec3 d = uniform_direction((glm::vec2(i, j) + random()) / float(steps));
            expected +=
                glm::dvec3(d) * double(environment.pdf_w(d)) * (4.0 * double(pi) / (double(steps) * steps));
        }
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(mean[axis], expected[axis], 0.006);
}

EnvironmentDescription constant() {
    EnvironmentDescription description;
    Bitmap pixel;
    pixel.width = pixel.height = 1;
    pixel.floats = {Rgb(0.5f, 1, 2)};
    description.map = {std::make_shared<const Bitmap>(pixel)};
    return description;
}

EnvironmentDescription with_sun(EnvironmentDescription description, float radius) {
    description.sun = {glm::normalize(glm::vec3(1, 2, -1)), radius, Rgb(50)};
    return description;
}

std::vector<std::pair<const char*, std::function<EnvironmentDescription()>>> kinds() {
    return {{"constant", constant},
            {"map", [] { return uneven(24, 13); }},
            {"large_map", [] { return uneven(2500, 700); }},
            {"sun", [] { return with_sun({}, 0.1f); }},
            {"sun_and_map", [] { return with_sun(uneven(24, 13), 0.2f); }}};
}

TEST_P(Environments, LookUpEqualsRadianceAndPdf) {
    for (int i = 0; i < 100000; ++i) {
        const glm::vec3 d = i % 2 ? uniform_direction(random()) : environment.sample(random(), random()).direction;
        const EnvironmentLight light = environment.look_up(d);
        ASSERT_EQ(light.radiance, environment.radiance(d));
        ASSERT_EQ(light.pdf_w, environment.pdf_w(d));
    }
}

INSTANTIATE_TEST_SUITE_P(kinds, Environments, testing::ValuesIn(kinds()),
                         [](const auto& p) { return p.param.first; });

TEST(Angles, AgreeWithTheStandardLibrary) {
    for (int i = 0; i <= 4096; ++i) {
        const float turns = static_cast<float>(i) / 4096;
        const double angle = 2 * 3.14159265358979323846 * turns;
        const glm::vec2 sc = sin_cos_of_turns(turns);
        ASSERT_NEAR(sc.x, std::sin(angle), 1e-6);
        ASSERT_NEAR(sc.y, std::cos(angle), 1e-6);
        for (const float radius : {1e-12f, 1.0f, 1e12f})
            ASSERT_NEAR(angle_of(radius * sc.x, radius * sc.y), std::atan2(sc.x, sc.y), 4e-7);
    }
    EXPECT_EQ(angle_of(0, 0), 0);
    EXPECT_EQ(angle_of(0, 1), 0);
    EXPECT_FLOAT_EQ(angle_of(0, -1), pi);
}

TEST(Environment, MapIsOrientedAsMitsubas) {
    // u = atan2(x, -z) / 2 pi: the left edge of the map is -z, and a quarter of its width further is +x. v = 0 is
    // +y.
    EnvironmentDescription description;
    Bitmap bitmap;
    bitmap.width = 64;
    bitmap.height = 32;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            bitmap.floats.emplace_back(x, y, 0);
    description.map = {std::make_shared<const Bitmap>(bitmap)};
    const Environment environment(description);
    EXPECT_NEAR(environment.radiance({1, 0, 0}).r, 15.5f, 0.01f);
    EXPECT_NEAR(environment.radiance({1, 0, 0}).g, 15.5f, 0.01f); // rows from pole to pole
    EXPECT_NEAR(environment.radiance({0, 0, 1}).r, 31.5f, 0.01f);
    EXPECT_NEAR(environment.radiance({-1, 0, 0}).r, 47.5f, 0.01f);
    EXPECT_NEAR(environment.radiance({0, 1, 0}).g, 0, 0.01f);
    EXPECT_NEAR(environment.radiance({0, -1, 0}).g, 31, 0.01f);
}

TEST(Environment, BlackMapHasNoFlux) {
    EnvironmentDescription description = constant();
    Bitmap black = *description.map->bitmap;
    black.floats = {Rgb(0)};
    description.map->bitmap = std::make_shared<const Bitmap>(black);
    const Environment environment(description);
    EXPECT_EQ(environment.flux(), 0);
    EXPECT_EQ(environment.pdf_w({0, 1, 0}), 0);
}

} // namespace

} // namespace tessera
