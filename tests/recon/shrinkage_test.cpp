// Pictures shrunk toward others: what that gains, and that it is consistent.
#include "recon/picture/shrinkage.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 80, height = 60;

RgbImage ramp() {
    RgbImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image(x, y) = Rgb(1 + 0.02f * static_cast<float>(x), 1, 0.5f);
    return image;
}

RgbImage with_noise(const RgbImage& image, unsigned seed, float deviation) {
    std::mt19937 random(seed);
    std::normal_distribution<float> noise(0, deviation);
    RgbImage result = image;
    for (Rgb& c : result)
        c += Rgb(noise(random), noise(random), noise(random));
    return result;
}

/// A picture of the ramp with noise, and other noise of the same size.
NoisyPicture noisy(float deviation) {
    return {with_noise(ramp(), 1, deviation), with_noise(RgbImage(width, height), 2, deviation)};
}

double error_of(const RgbImage& image) {
    return relative_rms_difference(image, ramp());
}

RgbImage shrunk(const RgbImage& target, const NoisyPicture& picture) {
    return shrink_toward(target, picture, {}, serial_for);
}

/// Half of two pictures that err alike, in different ways, has 0.71 of their error.
TEST(Shrinkage, OfTwoPicturesAsGoodIsTheMean) {
    const RgbImage target = with_noise(ramp(), 3, 0.1f);
    EXPECT_NEAR(error_of(shrunk(target, noisy(0.1f))) / error_of(target), 0.71, 0.03);
}

/// A target that is wrong by as much as noise still helps; one that is far off does next to no harm.
TEST(Shrinkage, HardlyFollowsWhatIsWrong) {
    for (const float wrong : {0.1f, 0.3f, 1.0f, 10.0f}) {
        RgbImage target = ramp();
        for (Rgb& c : target)
            c += Rgb(wrong);
        const NoisyPicture picture = noisy(0.1f);
        EXPECT_LT(error_of(shrunk(target, picture)), (wrong > 0.1f ? 1.01 : 0.8) * error_of(picture.image))
            << wrong;
    }
}

/// With noise that goes, the picture stays.
TEST(Shrinkage, IsConsistent) {
    RgbImage target = ramp();
    for (Rgb& c : target)
        c *= 1.2f;
    double last = 1;
    for (const float deviation : {0.1f, 0.01f, 0.001f}) {
        const double error = error_of(shrunk(target, noisy(deviation)));
        EXPECT_LT(error, 0.3 * last);
        last = error;
    }
    EXPECT_EQ(error_of(shrunk(target, {ramp(), RgbImage(width, height)})), 0);
}

TEST(Shrinkage, OfUnknownNoiseIsTheTarget) {
    const RgbImage target = with_noise(ramp(), 3, 0.1f), picture = shrunk(target, {ramp(), {}});
    EXPECT_TRUE(std::equal(target.begin(), target.end(), picture.begin()));
}

TEST(Shrinkage, TakesAnyPictureWithTheSameBitsByThreads) {
    const ParallelFor in_threads = [](int count, const std::function<void(int)>& body) {
        std::vector<std::jthread> threads;
        for (int i = count - 1; i >= 0; --i)
            threads.emplace_back(body, i);
    };
    for (const float scale : {0.0f, 1e-30f, 1.0f, 1e30f}) {
        NoisyPicture picture = noisy(0.1f);
        RgbImage target = with_noise(ramp(), 3, 0.1f);
        for (RgbImage* image : {&picture.image, &picture.noise, &target})
            for (Rgb& c : *image)
                c *= scale;
        const RgbImage alone = shrunk(target, picture), there = shrink_toward(target, picture, {}, in_threads);
        EXPECT_TRUE(std::all_of(alone.begin(), alone.end(), is_finite)) << scale;
        EXPECT_TRUE(std::equal(alone.begin(), alone.end(), there.begin())) << scale;
    }
}

/// What is not a number stays where it is.
TEST(Shrinkage, OnePixelSpoilsNoOthers) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    NoisyPicture picture = noisy(0.1f);
    picture.noise(20, 20) = Rgb(infinity, 0, -infinity);
    RgbImage target = with_noise(ramp(), 3, 0.1f);
    target(50, 30) = Rgb(infinity);
    target(60, 30) = Rgb(std::numeric_limits<float>::quiet_NaN());
    const RgbImage result = shrunk(target, picture);
    EXPECT_TRUE(std::all_of(result.begin(), result.end(), is_finite));
    EXPECT_LT(error_of(result), error_of(picture.image));
}

} // namespace

} // namespace tessera::test
