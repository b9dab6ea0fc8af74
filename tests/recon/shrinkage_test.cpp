// Trust in the difference between a picture and a smoother one, reconstruction (52).
#include "recon/guided/shrinkage.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 80, height = 60, radius = 4;

/// A picture with its noise, and a coarser picture without detail and noise.
struct Case {
    NoisyPlanes finer = black_planes<NoisyPlanes>(width, height, serial_for), coarser = finer;
    Plane dark = Plane(width, height, 0.2f);

    /// Detail and noise with these deviations, on a brightness of 1.
    Case(float detail, float noise, std::uint32_t seed = 1) {
        const RgbImage detail_image = random_image(width, height, seed, 0, detail),
                       picture_noise = random_image(width, height, seed + 1, 0, noise),
                       half_noise = random_image(width, height, seed + 2, 0, noise);
        for (int c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < dark.size(); ++i) {
                coarser[c].data()[i] = 1;
                finer[c].data()[i] = 1 + detail_image.data()[i][c] + picture_noise.data()[i][c];
                finer[c + 3].data()[i] = half_noise.data()[i][c];
            }
    }

    void scale(float factor) {
        for (NoisyPlanes* planes : {&finer, &coarser})
            for (Plane& plane : *planes)
                for (float& value : plane)
                    value *= factor;
        for (float& d : dark)
            d *= factor;
    }

    Plane trust(const ParallelFor& parallel_for = serial_for) const {
        const Plane any(width, height);
        ShrinkageScratch scratch{any, any, any};
        Plane trust = any;
        write_trust(finer, coarser, dark, radius, parallel_for, scratch, trust);
        return trust;
    }

    double mean_trust() const {
        double sum = 0;
        for (const float t : trust())
            sum += static_cast<double>(t);
        return sum / static_cast<double>(dark.size());
    }
};

TEST(Trust, IsSmallWhereTheDifferenceIsNoise) {
    EXPECT_LT(Case(0, 0.1f).mean_trust(), 0.2);
}

TEST(Trust, IsAboutAHalfWhereDetailAndNoiseAreEqual) {
    EXPECT_NEAR(Case(0.1f, 0.1f).mean_trust(), 0.5, 0.1);
}

TEST(Trust, GoesToOneAsNoiseVanishes) {
    double last = 1;
    for (const float noise : {0.1f, 0.03f, 0.01f}) {
        const double mistrust = 1 - Case(0.1f, noise).mean_trust();
        EXPECT_LT(mistrust, 0.6 * last) << noise;
        last = mistrust;
    }
    for (const float t : Case(0.1f, 0).trust())
        ASSERT_EQ(t, 1);
}

TEST(Trust, IsZeroWhereThereIsNoDifference) {
    for (const float t : Case(0, 0).trust())
        ASSERT_EQ(t, 0);
}

TEST(Trust, IsBetweenZeroAndOne) {
    for (const float detail : {0.0f, 0.1f, 1e10f})
        for (const float t : Case(detail, 0.1f).trust())
            ASSERT_TRUE(t >= 0 && t <= 1) << detail;
}

TEST(Trust, IsIndependentOfTheUnitOfRadiance) {
    Case scaled(0.1f, 0.1f);
    const Plane expected = scaled.trust();
    for (const float factor : {1e-10f, 1e20f}) {
        scaled.scale(factor);
        const Plane trust = scaled.trust();
        for (std::size_t i = 0; i < trust.size(); ++i)
            ASSERT_NEAR(trust.data()[i], expected.data()[i], 1e-3) << factor;
        scaled.scale(1 / factor);
    }
}

/// A lamp beside a wall. Differences are relative to brightness, and means are means of roots.
TEST(Trust, IsHardlyChangedByABrightNoisyPixel) {
    Case wall(0.3f, 0.1f);
    const float before = wall.trust()(40, 30);
    for (int c = 0; c < 3; ++c) {
        wall.finer[c](41, 30) = wall.coarser[c](41, 30) = 1e6f;
        wall.finer[c + 3](41, 30) = 1e5f;
    }
    EXPECT_NEAR(wall.trust()(40, 30), before, 0.15);
}

/// An invalid pixel changes trust only near it.
TEST(Trust, OfOneInvalidPixelIsLocal) {
    const Case valid(0.1f, 0.1f);
    const Plane expected = valid.trust();
    for (const float value : {1e30f, std::numeric_limits<float>::infinity()}) {
        Case invalid = valid;
        invalid.finer[0](20, 20) = invalid.finer[4](50, 30) = value;
        const Plane trust = invalid.trust();
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const int distance = std::min(std::max(std::abs(x - 20), std::abs(y - 20)),
                                              std::max(std::abs(x - 50), std::abs(y - 30)));
                ASSERT_TRUE(trust(x, y) >= 0 && trust(x, y) <= 1) << x << ' ' << y;
                if (distance > radius) {
                    ASSERT_EQ(trust(x, y), expected(x, y)) << x << ' ' << y;
                }
            }
    }
}

TEST(Trust, HasTheSameBitsWithThreads) {
    const Case c(0.1f, 0.1f);
    const Plane one = c.trust(), other = c.trust(threads_for);
    EXPECT_TRUE(std::equal(one.begin(), one.end(), other.begin()));
}

} // namespace

} // namespace tessera::test
