// The denoiser that is looked for at run time: what it does, and what is said where it is not there.
#include "recon/picture/oidn.h"
#include "recon/picture/reconstruct.h"
#include "tests/recon/test_images.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

TEST(Oidn, SmoothsThePicture) {
    if (!oidn_problem().empty())
        GTEST_SKIP() << oidn_problem();
    GradientImages images = noisy_images(96, 80);
    RgbImage truth(96, 80);
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 96; ++x)
            truth(x, y) = Rgb((x / 10 + y / 8) % 2 == 0 ? 0.9f : 0.2f, 0.4f, 0.1f + 0.01f * static_cast<float>(y));
    images.dx = images.dy = images.halves.dx = images.halves.dy = {};
    const RgbImage denoised = reconstruct(images, {Norm::oidn}).image;
    EXPECT_LT(relative_rms_difference(denoised, truth), 0.75 * relative_rms_difference(images.primal, truth));
    images.guides = {};
    EXPECT_LT(relative_rms_difference(reconstruct(images, {Norm::oidn}).image, truth),
              relative_rms_difference(images.primal, truth));
}

/// With gradients the picture is guided, drawn to what the denoiser makes of own paths; and as bright.
TEST(Oidn, DrawsGuidedToWhatItMakesOfOwnPaths) {
    if (!oidn_problem().empty())
        GTEST_SKIP() << oidn_problem();
    GradientImages images = noisy_images(96, 80);
    images.own = noisy_images(96, 80, 1, 11).primal;
    const RgbImage guided = reconstruct(images, {Norm::guided}).image,
                   drawn = reconstruct(images, {Norm::oidn}).image;
    const RgbImage target = denoised_by_oidn(images.own, images.guides);
    EXPECT_LT(relative_rms_difference(drawn, target), relative_rms_difference(guided, target));
    EXPECT_GT(relative_rms_difference(drawn, target), 0.4 * relative_rms_difference(guided, target));
    double sum = 0, sum_drawn = 0;
    for (std::size_t i = 0; i < guided.size(); ++i) {
        sum += static_cast<double>(luminance(guided.data()[i]));
        sum_drawn += static_cast<double>(luminance(drawn.data()[i]));
    }
    EXPECT_NEAR(sum_drawn, sum, 1e-3 * sum);
    images.halves = {}; // a single pass, whose noise nobody knows
    EXPECT_LT(relative_rms_difference(reconstruct(images, {Norm::oidn}).image, target), 0.03);
}

TEST(Oidn, SaysWhatIsMissing) {
    if (oidn_problem().empty())
        GTEST_SKIP() << "it is there";
    try {
        reconstruct(noisy_images(8, 8), {Norm::oidn});
        FAIL() << "without a library";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("TESSERA_OIDN"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace tessera::test
