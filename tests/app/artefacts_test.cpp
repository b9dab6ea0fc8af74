#include "app/experiment/artefacts.h"
#include "tests/recon/test_images.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tessera {
namespace {

using namespace test;

TEST(ReferenceNoise, IsSymmetricInBothReferences) {
    const RgbImage one = random_image(40, 24, 1, 1, 0.5f), other = random_image(40, 24, 2, 1, 0.5f);
    const ReferenceNoise a = measure_reference_noise(one, other), b = measure_reference_noise(other, one);
    EXPECT_GT(a.squared_error_error, 0);
    EXPECT_DOUBLE_EQ(a.squared_error_error, b.squared_error_error);
    EXPECT_DOUBLE_EQ(a.mean_error, b.mean_error);
    EXPECT_EQ(a.pieces[0], b.pieces[1]);
    EXPECT_EQ(a.pieces[1], b.pieces[0]);
}

TEST(ReferenceNoise, PredictsTheStandardErrorOfErrors) {
    // For the exact image, the floor-free relMSE is the mean of n1 n2 / (1 + epsilon), with the noise n1, n2 of
    // the halves.
    constexpr int runs = 200;
    const RgbImage truth(32, 24, Rgb(1));
    double squares = 0, expected = 0;
    for (std::uint32_t i = 0; i < runs; ++i) {
        RgbImage halves[2] = {random_image(32, 24, 2 * i, 1, 0.1f), random_image(32, 24, 2 * i + 1, 1, 0.1f)};
        squares += std::pow(measure_artefacts(truth, halves[0], halves[1]).error.relative_mse, 2) / runs;
        expected += std::pow(measure_reference_noise(halves[0], halves[1]).squared_error_error, 2) / runs;
    }
    EXPECT_NEAR(std::sqrt(expected / squares), 1, 0.25) << "five standard errors of 200 runs";
}

TEST(Artefacts, MatchKnownImages) {
    const RgbImage reference(20, 9, Rgb(2));
    RgbImage image(reference);
    image(17, 8) = Rgb(6); // in the last piece, of 4 x 1 pixels
    const Artefacts a = measure_artefacts(image, reference, reference);
    EXPECT_NEAR(a.error.relative_mse, 4 / 1.001 / 180, 1e-9) << "in units of the reference's mean";
    EXPECT_NEAR(a.mean, 1 + 2.0 / 180, 1e-6);
    EXPECT_EQ(a.worst_pixel, glm::ivec2(17, 8));
    EXPECT_NEAR(a.worst.at(0), 4 / 1.001, 1e-9);
    EXPECT_EQ(a.worst.size(), worst_count(180));
    EXPECT_EQ(a.worst.at(1), 0);
    ASSERT_EQ(a.pieces.size(), 6u);
    EXPECT_NEAR(a.pieces[0], 1 / std::sqrt(1.001), 1e-6);
    EXPECT_NEAR(a.pieces[5], 1.5 / std::sqrt(1.001), 1e-6);
}

/// Five of 200 pixels are far too bright, and three far too dark. A black pixel is only slightly off.
TEST(Artefacts, MeasureToneMappedAndTenfoldErrors) {
    RgbImage reference(20, 10, Rgb(1)), image = reference;
    reference(0, 0) = image(0, 0) = Rgb(0);
    for (int x = 5; x < 10; ++x)
        image(x, 3) = Rgb(1e6f);
    for (int x = 5; x < 8; ++x)
        image(x, 5) = Rgb(0.01f);
    image(0, 0) = Rgb(0.05f);
    const Artefacts a = measure_artefacts(image, reference, reference);
    EXPECT_DOUBLE_EQ(a.tenfold, 8 / 200.0);
    // The tone mapping maps 1 to 1/2 in units of the mean, 199/200, so bright pixels are off by at most 1/2.
    EXPECT_NEAR(a.tone_mapped, (5 * 0.25 + 3 * 0.49 * 0.49) / 200, 1e-4);
    EXPECT_EQ(measure_artefacts(reference, reference, reference).tenfold, 0);
}

TEST(Artefacts, AreFiniteForAllPixelValues) {
    const RgbImage reference(16, 8, Rgb(1e-6f));
    RgbImage image(reference);
    image(3, 4).g = NAN;
    image(5, 6) = Rgb(1e35f); // overflows floats in units of the reference's mean
    const Artefacts a = measure_artefacts(image, reference, reference);
    EXPECT_EQ(a.bad_pixels, 2u);
    for (const std::vector<double>& values : {a.worst, a.pieces, {a.error.relative_mse, a.mean}})
        for (double value : values)
            EXPECT_TRUE(std::isfinite(value)) << value;
}

} // namespace
} // namespace tessera
