// The cosine transform of many lines side by side, against its definition.
#include "recon/solvers/lane_dct.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace tessera {
namespace {

struct Buffer {
    explicit Buffer(int size) : re(static_cast<std::size_t>(size) * lanes), im(re.size()) {}
    ComplexLanes view() { return {re.data(), im.data()}; }
    std::vector<float> re, im;
};

class LaneDctSizes : public testing::TestWithParam<int> {};

TEST_P(LaneDctSizes, ForwardEqualsTheSumAndInverseReturnsTheLines) {
    const int size = GetParam();
    const LaneDct dct(size);
    Buffer lines(size), scratch(size);
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<float> line(size); // imaginary part of the last lane
    for (int x = 0; x < size; ++x) {
        for (int l = 0; l < lanes; ++l) {
            lines.re[dct.slot(x) * lanes + l] = uniform(engine);
            lines.im[dct.slot(x) * lanes + l] = uniform(engine);
        }
        line[x] = lines.im[dct.slot(x) * lanes + lanes - 1];
    }
    const ComplexLanes spectrum = dct.forward(lines.view(), scratch.view());
    for (int k = 0; k < size; ++k) {
        double sum = 0;
        for (int x = 0; x < size; ++x)
            sum += line[x] * std::cos(std::numbers::pi * k * (2 * x + 1) / (2.0 * size));
        EXPECT_NEAR(spectrum.im[k * lanes + lanes - 1], sum, 1e-6 * size) << k;
    }
    Buffer second(size);
    const ComplexLanes back = dct.inverse(spectrum, second.view());
    for (int x = 0; x < size; ++x)
        EXPECT_NEAR(back.im[dct.slot(x) * lanes + lanes - 1], line[x], 1e-5) << x;
}

INSTANTIATE_TEST_SUITE_P(Smooth, LaneDctSizes,
                         testing::Values(1, 2, 3, 4, 5, 6, 8, 9, 15, 16, 25, 60, 135, 256, 480));

TEST(SmoothSizes, NextIsTheLeastProductOfTwoThreeAndFive) {
    EXPECT_EQ(next_smooth(1), 1);
    EXPECT_EQ(next_smooth(7), 8);
    EXPECT_EQ(next_smooth(720), 720);
    EXPECT_EQ(next_smooth(1279), 1280);
    EXPECT_EQ(next_smooth(1366), 1440);
}

} // namespace
} // namespace tessera
