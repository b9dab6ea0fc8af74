// Radiance and position of the sun.
#include "render/sampling/sampling.h"
#include "render/scene/environment.h"
#include "render/scene/sky.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tessera {
namespace {

constexpr float degree = pi / 180;

double azimuth_of(glm::vec3 d) {
    return std::atan2(double(d.x), -double(d.z)) / degree;
}
double elevation_of(glm::vec3 d) {
    return std::asin(double(d.y)) / degree;
}

TEST(Sun, DimsAndReddensTowardTheHorizon) {
    for (const float turbidity : {1.0f, 3.0f, 10.0f}) {
        Rgb higher = sun_radiance(turbidity, pi / 2);
        EXPECT_GT(higher.b, 0);
        for (float elevation = 85; elevation >= 0; elevation -= 5) {
            const Rgb c = sun_radiance(turbidity, elevation * degree);
            EXPECT_LT(luminance(c), luminance(higher));
            EXPECT_LE(c.b / c.r, higher.b / higher.r);
            EXPECT_LT(c.g / c.r, higher.g / higher.r);
            EXPECT_GE(c.b, 0);
            higher = c;
        }
    }
    EXPECT_LT(luminance(sun_radiance(6, 0.5f)), luminance(sun_radiance(2, 0.5f)));
}

/// Direct light of a high sun in a clear sky is about 100 klx.
TEST(Sun, IlluminanceIsAbout100Kilolux) {
    const float lux = luminance(sun_irradiance(sun_radiance(3, 60 * degree))) * candela_per_radiance;
    EXPECT_GT(lux, 7e4f);
    EXPECT_LT(lux, 1.2e5f);
}

/// Expected means over the disk, for turbidity 3, come from Mitsuba 3.9's `sunsky` [Hosek 2013].
TEST(Sun, RadianceIsNearHosekAndWilkie) {
    const struct {
        float elevation;
        Rgb radiance;
    } cases[] = {{24.63f, {19559, 14937, 9291}}, {45, {21369, 17552, 12928}}, {70, {22052, 18588, 14541}}};
    for (const auto& c : cases) {
        const Rgb ratio = sun_radiance(3, c.elevation * degree) / c.radiance;
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(ratio[i], 1, 0.25f) << "elevation " << c.elevation << ", channel " << i;
    }
}

TEST(Sun, ResizingKeepsTheIrradiance) {
    const Rgb radiance(3, 2, 1);
    for (const float radius : {0.001f, 0.01f, 0.1f, 0.5f}) {
        const Rgb resized = resized_sun_radiance(radiance, radius) * disk_solid_angle(radius);
        EXPECT_LT(glm::length(resized - sun_irradiance(radiance)), 1e-5f * glm::length(sun_irradiance(radiance)));
    }
    EXPECT_NEAR(disk_solid_angle(pi), 4 * pi, 1e-5f);
}

/// The example of [Reda 2004, A.5]: Golden, Colorado, 17 October 2003. The elevation excludes refraction.
TEST(Sun, PositionAgreesWithRedaAndAndreas) {
    PlaceAndTime when;
    when.latitude = 39.742476;
    when.longitude = -105.1786;
    when.timezone = -7;
    when.year = 2003;
    when.month = 10;
    when.day = 17;
    when.hour = 12;
    when.minute = 30;
    when.second = 30;
    const glm::vec3 d = sun_direction(when);
    EXPECT_NEAR(glm::length(d), 1, 1e-6f);
    EXPECT_NEAR(elevation_of(d), 39.872046, 0.01);
    EXPECT_NEAR(azimuth_of(d) + 360, 194.340241, 0.01);
}

TEST(Sun, IsInTheEastInTheMorningAndLowInWinter) {
    PlaceAndTime when;
    when.hour = 7;
    EXPECT_GT(sun_direction(when).x, 0.5f);
    when.hour = 17;
    EXPECT_LT(sun_direction(when).x, -0.5f);
    when.hour = 0;
    EXPECT_LT(sun_direction(when).y, 0);
    when.hour = 11.75;
    EXPECT_GT(sun_direction(when).z, 0); // south
    const double summer = elevation_of(sun_direction(when));
    when.month = 12;
    EXPECT_GT(summer - elevation_of(sun_direction(when)), 40);
}

} // namespace
} // namespace tessera
