// Emitter sampling, the learned choice of lights, masks, and slides of projectors.
#include "render/scene/light.h"
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {

namespace {

using test::SceneBuilder;

TEST(AliasTable, ChoosesInProportionToTheWeights) {
    const std::vector<double> weights = {0.5, 0, 3, 1e-3, 2, 2.5};
    const AliasTable table(weights);
    std::vector<double> frequency(weights.size());
    constexpr int steps = 1200;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j)
            frequency[table.choose((glm::vec2(i, j) + 0.5f) / float(steps)).index] += 1.0 / (steps * steps);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(frequency[i], weights[i] / 8.001, 1e-3);
        EXPECT_NEAR(table.probability(i), weights[i] / 8.001, 1e-7); // thresholds have 24 bits
    }
}

TEST(AliasTable, ReportsTheExactProbabilityOfTinyWeights) {
    const AliasTable table(std::vector<double>{1, 1e-9});
    int tiny = 0;
    for (int i = 0; i < 1 << 24; ++i)
        tiny += table.choose({0.75f, static_cast<float>(i) * 0x1p-24f}).index == 1;
    EXPECT_FLOAT_EQ(table.probability(1), static_cast<float>(tiny) * 0x1p-25f);
    EXPECT_GE(tiny, 1);
}

TEST(AliasTable, WithoutWeightProbabilitiesAreZero) {
    const AliasTable table(std::vector<double>{0, 0});
    EXPECT_EQ(table.probability(0), 0);
    EXPECT_TRUE(AliasTable(std::vector<double>{}).empty());
}

/// Returns a scene with lights of each kind and very different powers.
std::shared_ptr<const Scene> all_kinds() {
    SceneBuilder b;
    b.quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, b.diffuse(Rgb(0.5f)));
    Texture pattern;
    pattern.kind = CheckerboardTexture{Rgb(4, 2, 1), Rgb(0, 0.5f, 3)};
    b.quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, b.diffuse(Rgb(0)), b.light(pattern));
    b.quad({-1, 3, -1}, {1, 0, 0}, {0, 0, 1}, b.diffuse(Rgb(0)), b.light(Rgb(0.1f)));
    b.point({{0, 1, 0}, Rgb(3)});
    b.point({{0.5f, 1, 0}, Rgb(3), {0, -1, 0}, 40, 20});
    b.directional({glm::normalize(glm::vec3(1, 1, 0)), Rgb(0.2f)});
    b.environment({Rgb(1), Rgb(0.5f)}, 1);
    b.camera({0, 1, 5}, {0, 1, 0}, 40);
    return b.build();
}

/// Estimates the irradiance at a point by emitter sampling without occlusion, separately for each kind of light.
TEST(LightTable, SamplesOverTheirPdfsGiveTheIrradiance) {
    const auto scene = all_kinds();
    const glm::vec3 receiver(0.2f, 0, 0.1f), normal(0, 1, 0);
    std::map<LightPoint::Kind, double> sums;
    constexpr int samples = 1000000;
    for (int i = 0; i < samples; ++i) {
        LightPoint light;
        if (!scene->lights().sample(receiver, Random(3, 1, static_cast<std::uint32_t>(i)), 0, light))
            continue;
        scene->lights().complete(light);
        const auto seen = light.seen_from(receiver);
        if (!seen)
            continue;
        ASSERT_NEAR(glm::length(seen->direction), 1, 1e-5f);
        sums[light.kind] +=
            std::max(glm::dot(seen->direction, normal), 0.0f) * luminance(seen->radiance) / seen->pdf_w / samples;
    }
    // Expected values: I cos / r^2 for points, a product for the directional light, and a fine sum for the
    // environment, which blends into its lower half at the horizon.
    const double point = 3 * 1 / std::pow(0.04 + 1 + 0.01, 1.5);
    const double to_spot2 = 0.09 + 1 + 0.01;
    const double angle = std::acos(1 / std::sqrt(to_spot2)) * 180 / double(pi);
    const double spot = 3 * std::min(1.0, (40 - angle) / 20) / std::pow(to_spot2, 1.5);
    EXPECT_NEAR(sums[LightPoint::Kind::point], point + spot, 0.02 * (point + spot));
    EXPECT_NEAR(sums[LightPoint::Kind::directional], 0.2 * std::sqrt(0.5), 0.02 * 0.2);
    double above = 0;
    for (int i = 0; i < 20000; ++i) {
        const float cosine = (float(i) + 0.5f) / 20000;
        const glm::vec3 d(std::sqrt(1 - cosine * cosine), cosine, 0);
        above += 2 * double(pi) * cosine * luminance(scene->lights().environment()->radiance(d)) / 20000;
    }
    EXPECT_NEAR(sums[LightPoint::Kind::environment], above, 0.02 * above);
    EXPECT_GT(sums[LightPoint::Kind::surface], 1); // judge_test.cpp tests the value
}

TEST(LightTable, ChoosesByPowerAndLeavesOutBlackTriangles) {
    SceneBuilder b;
    const int black = b.diffuse(Rgb(0));
    b.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, black, b.light(Rgb(9)));
    b.quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, black, b.light(Rgb(1)));
    b.quad({0, 0, 2}, {1, 0, 0}, {0, 1, 0}, black, b.light(Rgb(0)));
    b.quad({0, 0, 3}, {1, 0, 0}, {2, 0, 0}, black, b.light(Rgb(5))); // no area
    const auto scene = b.build();
    const LightTable table(scene->description(), scene->radius());
    EXPECT_EQ(table.size(), 4u); // triangles of two quads
    EXPECT_FLOAT_EQ(table.pdf_a(0), 0.9f);
    EXPECT_FLOAT_EQ(table.pdf_a(1), 0.1f);
    EXPECT_EQ(table.pdf_a(2), 0);
    EXPECT_EQ(LightTable(scene->description(), scene->radius(), {1, 0, 1, 1}).size(), 2u);
    EXPECT_FLOAT_EQ(LightTable(scene->description(), scene->radius(), {1, 9, 1, 1}).pdf_a(1), 0.5f);
}

/// Returns the probability of each light, in the order of LightTable::powers().
std::vector<double> probabilities_of(const Scene& scene) {
    const std::vector<double>& power = scene.lights().powers();
    const std::vector<double> factors = learn_light_selection(scene);
    std::vector<double> probabilities(power.size());
    std::transform(power.begin(), power.end(), factors.begin(), probabilities.begin(), std::multiplies<>());
    const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
    for (double& p : probabilities)
        p /= sum;
    return probabilities;
}

/// Returns a floor, 60 units wide, under two spot lights and a sky.
std::shared_ptr<const Scene> spots_under_the_sky() {
    SceneBuilder b;
    b.quad({-30, 0, -30}, {0, 0, 60}, {60, 0, 0}, b.diffuse(Rgb(0.7f)));
    for (const float x : {-2.0f, 2.0f})
        b.point({{x, 5, 0}, Rgb(60), {0, -1, 0}, 25, 20});
    b.environment({Rgb(0.1f)}, 1);
    b.camera({0, 4, 8}, {0, 0, 0}, 45);
    return b.build();
}

TEST(LightChoice, SamplesSpotsUnderAStrongSky) {
    const auto scene = spots_under_the_sky();
    const std::vector<double> power = scene->lights().powers();
    ASSERT_EQ(power.size(), 3u);
    EXPECT_GT(power[2], 50 * (power[0] + power[1])) << "by power, the spots get hardly any samples";
    const std::vector<double> probabilities = probabilities_of(*scene);
    EXPECT_GT(probabilities[0], 0.3);
    EXPECT_GT(probabilities[1], 0.3);
    EXPECT_GT(probabilities[2], 0.1) << "it may light places that the learning paths missed";
    EXPECT_EQ(learn_light_selection(*scene), learn_light_selection(*spots_under_the_sky()));
}

TEST(LightChoice, HiddenLampGetsFewSamples) {
    SceneBuilder b;
    b.room({0, 0, 0, 0, b.diffuse(Rgb(0.5f))});
    b.quad({-0.3f, 0.9f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}, 0, b.light(Rgb(1)));
    b.point({{0, 50, 0}, Rgb(1000)}); // above the ceiling
    b.camera({0, 0, 3}, {0, 0, 0}, 40);
    const std::vector<double> probabilities = probabilities_of(*b.build());
    EXPECT_GT(probabilities[0], 0.8);
    EXPECT_GT(probabilities[1], 0.1);
}

TEST(LightChoice, FactorsDoNotChangeTheMean) {
    const auto scene = all_kinds();
    const auto estimate = [&](const std::vector<double>& factors) {
        const LightTable table(scene->description(), scene->radius(), factors);
        double sum = 0;
        constexpr int count = 400000;
        for (int i = 0; i < count; ++i) {
            LightPoint point;
            if (!table.sample({0.2f, 0.1f, 0.3f}, Random(7, static_cast<std::uint32_t>(i), 0), 0, point))
                continue;
            table.complete(point);
            if (const auto ray = point.seen_from({0.2f, 0.1f, 0.3f}); ray && ray->direction.y > 0)
                sum += luminance(ray->radiance) * ray->direction.y / ray->pdf_w;
        }
        return sum / count;
    };
    const double by_power = estimate({}), learned = estimate(learn_light_selection(*scene));
    EXPECT_NEAR(learned / by_power, 1, 0.02);
    EXPECT_NEAR(estimate({3, 40, 0.2, 1, 5, 0.5}) / by_power, 1, 0.02);
}

TEST(LightTable, MayBeHitIsFalseForRaysThatMissAllLights) {
    SceneBuilder b;
    b.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, b.diffuse(Rgb(0)), b.light(Rgb(9)));
    const auto scene = b.build();
    EXPECT_TRUE(scene->lights().may_be_hit({{0.5f, 0.5f, 2}, {0, 0, -1}}));
    EXPECT_FALSE(scene->lights().may_be_hit({{0.5f, 0.5f, 2}, {0, 0, 1}}));
    SceneBuilder dark;
    dark.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, dark.diffuse(Rgb(0)));
    dark.point({{0, 0, 1}, Rgb(1)});
    EXPECT_FALSE(dark.build()->lights().may_be_hit({{0.5f, 0.5f, 2}, {0, 0, -1}}));
}

/// The fraction of blocked rays is the opacity, for single rays and for packets.
TEST(Intersector, MaskBlocksRaysByItsOpacity) {
    SceneBuilder b;
    Material half{"half", DiffuseMaterial{}, true};
    half.opacity = Texture(Rgb(0.3f));
    b.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, b.material(half));
    const auto scene = b.build();
    int hits = 0, blocked = 0, blocked_in_packets = 0;
    constexpr int side = 200;
    SegmentLanes segments;
    LaneMask active, result;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const glm::vec3 from((glm::vec2(i, j) + 0.3f) / float(side), 1);
            Hit hit;
            hits += scene->intersector().closest({from, {0, 0, -1}}, hit);
            const glm::vec3 to = from - glm::vec3(0, 0, 2);
            blocked += scene->intersector().occluded({from, to});
            segments.from.set(j, from);
            segments.to.set(j, to);
            active[j] = -1;
        }
        scene->intersector().occluded(segments, active, side, result);
        for (int j = 0; j < side; ++j)
            blocked_in_packets += result[j] != 0;
    }
    const double count = side * side;
    for (int n : {hits, blocked, blocked_in_packets})
        EXPECT_NEAR(n / count, 0.3, 4 * std::sqrt(0.21 / count));
}

/// Returns a picture of 2x1 pixels.
Texture two_pixels() {
    Bitmap bitmap;
    bitmap.width = 2;
    bitmap.height = 1;
    bitmap.floats = {Rgb(1, 0, 0), Rgb(0, 3, 0)};
    Texture texture;
    texture.kind = BitmapTexture{std::make_shared<const Bitmap>(bitmap), Filter::nearest};
    return texture;
}

TEST(Slide, IsOrientedAsACameraPictureAndHasItsPower) {
    PointLight light;
    light.slide = Slide{two_pixels(), {glm::mat4(1), 90, FovAxis::x}, Slide::Kind::irradiance};
    const auto toward = [&](float x, float y) { return light.toward(glm::normalize(glm::vec3(x, y, 1))); };
    EXPECT_GT(toward(0.9f, 0.4f).r, 0); // +x is to the left
    EXPECT_GT(toward(-0.9f, -0.4f).g, 0);
    EXPECT_EQ(toward(-0.9f, -0.4f).r, 0);
    EXPECT_EQ(toward(0.9f, 0.6f), Rgb(0)); // outside: the picture is half as high as wide
    EXPECT_EQ(toward(1.1f, 0), Rgb(0));
    double power = 0; // integral over the picture at distance 1, 2 units wide and 1 high
    constexpr int steps = 200;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const glm::vec3 p(2 * (float(i) + 0.5f) / steps - 1, (float(j) + 0.5f) / steps - 0.5f, 1);
            const float d = glm::length(p);
            power += luminance(light.toward(p / d)) / (d * d * d) * 2.0 / (steps * steps);
        }
    EXPECT_NEAR(light.power(), power, 1e-3 * power);
    light.slide->kind = Slide::Kind::share;
    EXPECT_EQ(toward(0.9f, 0.9f), Rgb(1, 0, 0)); // square
}

} // namespace

} // namespace tessera
