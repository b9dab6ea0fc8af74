// The sky model of [Preetham 1999].
#include "render/sampling/sampling.h"
#include "render/scene/environment.h"
#include "render/scene/sky.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tessera {
namespace {

glm::vec3 at(float elevation_degrees, float azimuth_degrees) {
    return direction_of_map({azimuth_degrees / 360, (90 - elevation_degrees) / 180});
}

Sky sky_of(float turbidity, float sun_elevation_degrees, float sun_azimuth_degrees = 0) {
    SkySettings settings;
    settings.turbidity = turbidity;
    settings.sun_direction = at(sun_elevation_degrees, sun_azimuth_degrees);
    return make_sky(settings);
}

float zenith_candela(const Sky& sky) {
    return luminance(sky_radiance(sky, {0, 1, 0})) * candela_per_radiance;
}

/// Returns the irradiance on horizontal ground.
Rgb irradiance(const Sky& sky) {
    const int n = 64;
    Rgb sum(0);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const float z = (float(i) + 0.5f) / n, azimuth = 2 * pi * (float(j) + 0.5f) / n;
            const float r = std::sqrt(1 - z * z);
            sum += z * sky_radiance(sky, {r * std::cos(azimuth), z, r * std::sin(azimuth)});
        }
    return sum * (2 * pi / (n * n));
}

TEST(Sky, MapAndDirectionAreInverse) {
    for (const glm::vec2 uv : {glm::vec2(0.1f, 0.2f), glm::vec2(0.6f, 0.7f), glm::vec2(0.95f, 0.5f)})
        EXPECT_LT(glm::length(map_of_direction(direction_of_map(uv)) - uv), 1e-5f);
    EXPECT_LT(glm::length(direction_of_map({0, 0.5f}) - glm::vec3(0, 0, -1)), 1e-6f);
    EXPECT_LT(glm::length(direction_of_map({0.25f, 0.5f}) - glm::vec3(1, 0, 0)), 1e-6f);
}

/// Values of Yz [Preetham 1999, A.2], in cd/m^2.
TEST(Sky, ZenithHasTheLuminanceOfThePaper) {
    EXPECT_NEAR(zenith_candela(sky_of(3, 90)), 29477, 29477 * 2e-3);
    EXPECT_NEAR(zenith_candela(sky_of(3, 45)), 7320, 7320 * 2e-3);
    EXPECT_NEAR(zenith_candela(sky_of(2, 5)), 2222, 2222 * 2e-3);
    EXPECT_NEAR(zenith_candela(sky_of(6, 0)), 1126, 1126 * 2e-3);
}

/// Expected irradiances (luminance, ground albedo 0.2) come from Mitsuba 3.9's `sunsky` [Hosek 2012].
TEST(Sky, BrightnessIsWithinAThirdOfHosekAndWilkie) {
    const struct {
        float turbidity, elevation, irradiance;
    } cases[] = {{2, 24.63f, 0.1671f}, {2, 45, 0.1986f},     {2, 70, 0.2167f}, {3, 24.63f, 0.1897f},
                 {3, 45, 0.2304f},     {3, 70, 0.2494f},     {4, 5, 0.0983f},  {4, 24.63f, 0.2248f},
                 {4, 45, 0.2802f},     {6, 24.63f, 0.2766f}, {6, 45, 0.3671f}, {6, 70, 0.3972f}};
    for (const auto& c : cases) {
        const float ratio = hosek_scale * luminance(irradiance(sky_of(c.turbidity, c.elevation))) / c.irradiance;
        EXPECT_GT(ratio, 0.75f) << "turbidity " << c.turbidity << ", elevation " << c.elevation;
        EXPECT_LT(ratio, 1.33f) << "turbidity " << c.turbidity << ", elevation " << c.elevation;
    }
}

TEST(Sky, IsBlueAboveAndPalerAtTheHorizon) {
    const Sky sky = sky_of(3, 45);
    const Rgb above = sky_radiance(sky, {0, 1, 0}), low = sky_radiance(sky, at(2, 90));
    EXPECT_GT(above.b / above.r, 1.5f);
    EXPECT_LT(low.b / low.r, above.b / above.r);
}

TEST(Sky, IsSymmetricAboutTheSunsAzimuth) {
    const Sky sky = sky_of(4, 30, 130);
    for (float elevation = 5; elevation < 90; elevation += 17)
        for (float away = 10; away < 180; away += 31) {
            const Rgb left = sky_radiance(sky, at(elevation, 130 - away));
            const Rgb right = sky_radiance(sky, at(elevation, 130 + away));
            EXPECT_LT(glm::length(left - right), 2e-5f * glm::length(left));
        }
}

TEST(Sky, TurnsWithTheSun) {
    EXPECT_LT(
        glm::length(sky_radiance(sky_of(3, 30, 20), at(40, 70)) - sky_radiance(sky_of(3, 30, 120), at(40, 170))),
        1e-6f);
}

TEST(Sky, IsPositiveAboveTheHorizonAndBlackBelow) {
    for (const float turbidity : {1.0f, 2.0f, 3.0f, 6.0f, 10.0f})
        for (const float sun : {0.0f, 1.0f, 20.0f, 60.0f, 90.0f}) {
            const Sky sky = sky_of(turbidity, sun, 40);
            for (float elevation = 0.1f; elevation <= 90; elevation += 8.99f)
                for (float azimuth = 0; azimuth < 360; azimuth += 30) {
                    const Rgb c = sky_radiance(sky, at(elevation, azimuth));
                    ASSERT_TRUE(is_finite(c));
                    ASSERT_GT(luminance(c), 0) << turbidity << " " << sun << " " << elevation << " " << azimuth;
                    ASSERT_GE(std::min({c.r, c.g, c.b}), 0);
                }
            EXPECT_TRUE(is_black(sky_radiance(sky, at(-0.1f, 10))));
            EXPECT_TRUE(is_black(sky_radiance(sky, {0, -1, 0})));
        }
}

/// Also across the sun, and as the sun sets.
TEST(Sky, IsContinuous) {
    const Sky sky = sky_of(3, 30, 90);
    for (float elevation = 1; elevation < 89; elevation += 0.5f) {
        const Rgb a = sky_radiance(sky, at(elevation, 90)), b = sky_radiance(sky, at(elevation + 0.01f, 90));
        EXPECT_LT(glm::length(a - b), 2e-3f * glm::length(a)) << elevation;
    }
    const Rgb set = sky_radiance(sky_of(3, 0), at(40, 0)), rising = sky_radiance(sky_of(3, 0.01f), at(40, 0));
    EXPECT_LT(glm::length(set - rising), 2e-3f * glm::length(set));
    EXPECT_EQ(sky_radiance(sky_of(3, -20), at(40, 50)), sky_radiance(sky_of(3, 0), at(40, 50)));
}

TEST(Sky, StretchReachesBelowTheHorizon) {
    SkySettings settings;
    settings.sun_direction = at(30, 90);
    const Sky plain = make_sky(settings);
    settings.stretch = 2;
    const Sky stretched = make_sky(settings);
    EXPECT_LT(glm::length(sky_radiance(stretched, at(-30, 20)) - sky_radiance(plain, at(30, 20))), 1e-6f);
    EXPECT_FALSE(is_black(sky_radiance(stretched, at(-89, 20))));
}

TEST(Sky, ExtensionFadesToTheNadir) {
    SkySettings settings;
    settings.sun_direction = at(30, 90);
    settings.extend = true;
    const Sky sky = make_sky(settings);
    const Rgb horizon = sky_radiance(sky, at(0.01f, 20));
    EXPECT_LT(glm::length(sky_radiance(sky, at(-0.01f, 20)) - horizon), 1e-3f * glm::length(horizon));
    EXPECT_LT(glm::length(sky_radiance(sky, at(-45, 20)) - 0.5f * horizon), 1e-2f * glm::length(horizon));
    EXPECT_LT(luminance(sky_radiance(sky, {0, -1, 0})), 1e-5f);
}

TEST(Sky, BitmapHoldsTheRadianceAtItsPixels) {
    SkySettings settings;
    settings.sun_direction = at(40, 200);
    settings.scale = Rgb(2, 3, 4);
    const Sky sky = make_sky(settings);
    const Bitmap map = sky_bitmap(sky, 32);
    ASSERT_EQ(map.width, 32);
    ASSERT_EQ(map.height, 16);
    ASSERT_EQ(map.floats.size(), 32u * 16u);
    const Rgb expected = sky_radiance(sky, direction_of_map({5.5f / 32, 3.0f / 15}));
    EXPECT_LT(glm::length(map.texel(5, 3) - expected), 1e-5f * glm::length(expected));
    EXPECT_TRUE(is_black(map.texel(5, 8)));
    settings.scale = Rgb(1);
    const Rgb unscaled = sky_radiance(make_sky(settings), direction_of_map({5.5f / 32, 3.0f / 15}));
    EXPECT_LT(glm::length(map.texel(5, 3) - Rgb(2, 3, 4) * unscaled), 1e-6f);
}

} // namespace
} // namespace tessera
