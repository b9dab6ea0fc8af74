// Open Image Denoise, whose library is found at run time.
#include "recon/picture/oidn.h"
#include "recon/picture/reconstruct.h"
#include "tests/recon/test_images.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

TEST(Oidn, RemovesNoise) {
    if (!oidn_problem().empty())
        GTEST_SKIP() << oidn_problem();
    GradientImages images = noisy_images(96, 80);
    const RgbImage truth = steps_and_ramps(96, 80);
    images.dx = images.dy = images.halves.dx = images.halves.dy = {};
    const RgbImage denoised = reconstruct(images, {Norm::oidn}).image;
    EXPECT_LT(relative_rms_difference(denoised, truth), 0.75 * relative_rms_difference(images.primal, truth));
    images.features = {};
    EXPECT_LT(relative_rms_difference(reconstruct(images, {Norm::oidn}).image, truth),
              relative_rms_difference(images.primal, truth));
}

/// Gradients, fireflies and half differences change nothing.
TEST(Oidn, DenoisesTheRawPrimalAlone) {
    if (!oidn_problem().empty())
        GTEST_SKIP() << oidn_problem();
    GradientImages images = noisy_images(96, 80);
    const RgbImage expected = denoised_by_oidn(images.primal, images.features);
    add_fireflies(images, 8, 100000);
    images.primal = noisy_images(96, 80).primal;
    EXPECT_LT(relative_difference(reconstruct(images, {Norm::oidn}).image, expected), 1e-5);
}

TEST(Oidn, NamesTheVariableThatFindsTheLibrary) {
    if (oidn_problem().empty())
        GTEST_SKIP() << "the library is installed";
    try {
        reconstruct(noisy_images(8, 8), {Norm::oidn});
        FAIL() << "no error without the library";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("TESSERA_OIDN"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace tessera::test
