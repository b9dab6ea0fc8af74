#include "app/cli/picture_layers.h"
#include "render/io/available_memory.h"
#include "tests/support/memory_limit.h"

#include <utility>

#include <gtest/gtest.h>

namespace tessera {
namespace {

constexpr int width = 640, height = 480;

GradientImages grey_images() {
    GradientImages images;
    images.primal = RgbImage(width, height, Rgb(0.5f));
    images.dx = images.dy = RgbImage(width, height);
    images.very_direct = RgbImage(width, height, Rgb(0.25f));
    return images;
}

TEST(PictureLayers, WithoutMemoryToReconstructWhatIsRenderedIsKept) {
    if (!test::can_limit_memory)
        GTEST_SKIP() << "sanitizers take all address space";
    ThreadPool pool(1);
    std::vector<ReconstructionStats> stats;
    GradientImages images = grey_images();
    {
        const test::MemoryLimit limit(8 << 20);
        EXPECT_THROW(reconstruct_layers(std::move(images), {{Norm::weighted}, {}, true}, pool, stats),
                     OutOfMemory);
        ASSERT_EQ(images.primal.width(), width); // as they were
        const ExrFile exr = unreconstructed_layers(std::move(images), true);
        ASSERT_EQ(exr.layers.size(), 4u);
        EXPECT_EQ(exr.layers[0].name, "primal");
        EXPECT_EQ(exr.layers[2].name, "dy");
        EXPECT_EQ(exr.layers[3].image(3, 2), Rgb(0.25f));
    }
    images = grey_images();
    const ExrFile plain = unreconstructed_layers(std::move(images), false);
    ASSERT_EQ(plain.layers.size(), 1u);
    EXPECT_EQ(plain.layers[0].image(3, 2), Rgb(0.75f));
    EXPECT_TRUE(stats.empty());
}

TEST(PictureLayers, TellWhatTheyTakeTogether) {
    const glm::ivec2 size(width, height);
    const ReconstructionLayers one{{Norm::l2}}, two{{Norm::l2, Norm::none}};
    RenderSettings gpr, pt;
    gpr.method = Method::gpr;
    gpr.basis = Basis::none;
    pt.method = Method::pt;
    EXPECT_GT(bytes_for_layers(size, gpr, one, 1), bytes_for_layers(size, pt, one, 1));
    EXPECT_GE(bytes_for_layers(size, gpr, {{Norm::none, Norm::l2}}, 1),
              bytes_for_layers(size, gpr, one, 1) + sizeof(Rgb) * width * height);
    EXPECT_EQ(bytes_for_layers(size, gpr, two, 1), bytes_for_layers(size, gpr, one, 1));
    RenderSettings albedo = gpr;
    albedo.basis = Basis::albedo;
    EXPECT_GE(bytes_for_layers(size, albedo, one, 1),
              bytes_for_layers(size, gpr, one, 1) + Demodulation::bytes_a_pixel * width * height);
}

} // namespace
} // namespace tessera
