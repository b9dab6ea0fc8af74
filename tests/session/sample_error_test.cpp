// The error estimated from the variance of the samples, compared with the true error.

#include "recon/metrics/metrics.h"
#include "recon/metrics/sample_error.h"
#include "recon/picture/reconstruct.h"
#include "render/load/mitsuba_xml.h"
#include "render/run/render.h"
#include "render/scene/scene.h"

#include <map>
#include <memory>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

constexpr glm::ivec2 size(64, 48);

Render render_of(const std::shared_ptr<const Scene>& scene, Method method, unsigned seed) {
    RenderSettings settings;
    settings.method = method;
    settings.max_depth = 6;
    settings.seed = seed;
    return {scene, scene->camera(), size, settings};
}

/// Reconstructs the image without directly visible emission, because the estimate excludes the noise at its edges.
RgbImage picture(GradientImages images, Norm norm) {
    images.very_direct = {};
    ReconstructionSettings settings;
    settings.norm = norm;
    return reconstruct(images, settings).image;
}

TEST(SampleError, MatchesTheTrueErrorOfThePrimal) {
    const auto scene =
        std::make_shared<const Scene>(load_mitsuba_xml(TESSERA_SOURCE_DIR "/assets/cornell-box.xml").description);
    ThreadPool pool(2);
    RgbImage truth[2];
    for (unsigned half = 0; half < 2; ++half) {
        Render render = render_of(scene, Method::gpr, 100 + half);
        for (int i = 0; i < 200; ++i)
            render.pass(pool);
        truth[half] = picture(render.images(), Norm::l2);
    }
    constexpr unsigned seeds = 12;
    for (const Method method : {Method::pt, Method::gpr}) {
        std::map<int, double> estimates, errors; // by samples per pixel
        for (unsigned seed = 1; seed <= seeds; ++seed) {
            Render render = render_of(scene, method, seed);
            EXPECT_FALSE(estimate_sample_error(render.images(), RgbImage(size.x, size.y)));
            for (int spp = 1; spp <= 64; ++spp) {
                render.pass(pool);
                // 2 samples make two halves. With 5 samples, one half has one more than the other; with 24, eight
                // more.
                if (spp != 2 && spp != 5 && spp != 16 && spp != 24 && spp != 64)
                    continue;
                const GradientImages images = render.images();
                const Norm best = images.has_gradients() ? Norm::guided : Norm::smoothed;
                const auto estimate = estimate_sample_error(images, picture(images, best));
                ASSERT_TRUE(estimate) << spp;
                if (spp == 2)
                    continue;
                estimates[spp] += estimate->relative_mse;
                errors[spp] +=
                    measure_floor_free_error(picture(images, Norm::none), truth[0], truth[1]).relative_mse;
            }
        }
        // The estimate does not see the gain from stratification across the halves, which is large for PT.
        for (const auto& [spp, error] : errors)
            EXPECT_NEAR(estimates[spp] / error, method == Method::pt ? 1.3 : 1, method == Method::pt ? 0.3 : 0.15)
                << spp << " " << short_name(method);
    }
}

// If few pixels have found light, the brightness of the dark pixels is unknown, and so is the error.
TEST(SampleError, IsUnknownIfTheBrightnessIsUnknown) {
    GradientImages images;
    images.primal = images.halves.primal = RgbImage(40, 40, Rgb(0));
    for (int y = 0; y < 40; y += 20)
        for (int x = 0; x < 40; x += 20)
            images.primal(x, y) = images.halves.primal(x, y) = Rgb(50);
    EXPECT_TRUE(estimate_sample_error(images, images.primal)); // few lit pixels, whose brightness is known
    for (int y = 0; y < 40; y += 3)
        for (int x = 0; x < 40; x += 3)
            images.primal(x, y) = images.halves.primal(x, y) = Rgb(50);
    EXPECT_FALSE(estimate_sample_error(images, images.primal));
    images.halves.primal = RgbImage(40, 40, Rgb(0.5f));
    images.primal = RgbImage(40, 40, Rgb(2));
    ASSERT_TRUE(estimate_sample_error(images, images.primal));
    EXPECT_NEAR(estimate_sample_error(images, images.primal)->relative_mse, 0.0625, 1e-3);
    EXPECT_FALSE(estimate_sample_error(images, RgbImage(20, 20)));       // of another size
    images.primal = images.halves.primal = RgbImage(40, 40, Rgb(1e38f)); // sums overflow
    EXPECT_FALSE(estimate_sample_error(images, images.primal));
}

} // namespace
} // namespace tessera::test
