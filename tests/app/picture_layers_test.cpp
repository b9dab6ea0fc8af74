#include "app/cli/picture_layers.h"
#include "render/io/available_memory.h"
#include "tests/support/memory_limit.h"

#include <utility>
#include <vector>

#include <glm/vec3.hpp>
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

TEST(PictureLayers, KeepTheRenderIfMemoryForReconstructionIsMissing) {
    if (!test::can_limit_memory)
        GTEST_SKIP() << "sanitizers take all address space";
    ThreadPool pool(1);
    std::vector<ReconstructionStats> stats;
    GradientImages images = grey_images();
    {
        const test::MemoryLimit limit(8 << 20);
        EXPECT_THROW(reconstruct_layers(std::move(images), {{Norm::weighted}, {}, true}, pool, stats),
                     OutOfMemory);
        ASSERT_EQ(images.primal.width(), width); // the images are unchanged
        const ExrFile exr = unreconstructed_layers(std::move(images), true);
        ASSERT_NE(find_layer(exr, ""), nullptr);
        EXPECT_EQ((*find_layer(exr, ""))(3, 2), Rgb(0.75f)); // the raw primal
        ASSERT_NE(find_layer(exr, without_direct_layer), nullptr);
        EXPECT_EQ((*find_layer(exr, without_direct_layer))(3, 2), Rgb(0.5f));
        EXPECT_NE(find_layer(exr, "dx"), nullptr);
        EXPECT_NE(find_layer(exr, "dy"), nullptr);
        EXPECT_EQ((*find_layer(exr, direct_layer))(3, 2), Rgb(0.25f));
    }
    images = grey_images();
    const ExrFile plain = unreconstructed_layers(std::move(images), false);
    ASSERT_EQ(plain.layers.size(), 1u);
    EXPECT_EQ(plain.layers[0].image(3, 2), Rgb(0.75f));
    EXPECT_TRUE(stats.empty());
}

TEST(PictureLayers, HaveTheRawPrimalUnlessThePictureEqualsIt) {
    ThreadPool pool(1);
    std::vector<ReconstructionStats> stats;
    GradientImages images = grey_images();
    images.primal(3, 2) = Rgb(7); // an outlier, which L2 distributes
    const ExrFile l2 = reconstruct_layers(GradientImages(images), {{Norm::l2}}, pool, stats);
    ASSERT_EQ(l2.layers.size(), 2u);
    EXPECT_EQ(l2.layers[1].name, primal_layer);
    EXPECT_EQ(l2.layers[1].image(3, 2), Rgb(7.25f));
    EXPECT_LT(l2.layers[0].image(3, 2).r, 7);
    const ExrFile none = reconstruct_layers(GradientImages(images), {{Norm::none}}, pool, stats);
    ASSERT_EQ(none.layers.size(), 1u);
    EXPECT_EQ(none.layers[0].image(3, 2), Rgb(7.25f));
    EXPECT_EQ(find_layer(none, primal_layer), nullptr);
}

TEST(PictureLayers, HaveFeaturesUnderTheNamesOfOtherPrograms) {
    ThreadPool pool(1);
    std::vector<ReconstructionStats> stats;
    GradientImages images = grey_images();
    images.features = {RgbImage(width, height, Rgb(0.5f)), Image<glm::vec3>(width, height, glm::vec3(0, 0, 1)),
                       Image<float>(width, height, 0.25f), Image<float>(width, height, 0.75f)};
    images.features.nearness(3, 2) = 0; // no surface
    const ExrFile exr = reconstruct_layers(std::move(images), {{Norm::none}, {}, true}, pool, stats);
    const auto channels_of = [&](const char* name) {
        for (const ExrLayer& layer : exr.layers)
            if (layer.name == name)
                return layer.channels;
        ADD_FAILURE() << name;
        return ExrChannels::rgb;
    };
    EXPECT_EQ(channels_of("albedo"), ExrChannels::rgb);
    EXPECT_EQ(channels_of("N"), ExrChannels::xyz);
    EXPECT_EQ(channels_of("Z"), ExrChannels::single);
    EXPECT_EQ(channels_of("roughness"), ExrChannels::single);
    EXPECT_EQ((*find_layer(exr, "Z"))(4, 2).r, 4);
    EXPECT_EQ((*find_layer(exr, "Z"))(3, 2).r, no_depth);
    EXPECT_EQ((*find_layer(exr, "nearness"))(3, 2).r, 0);
}

/// The header names only reconstructions that redistributed radiance.
TEST(PictureLayers, RecordTheRedistributedFraction) {
    ExrFile exr;
    record_redistributed(exr, {{Norm::guided, 0, 0, 1, 0, 0.25}, {Norm::l2, 0, 0, 1, 0, 0}});
    EXPECT_EQ(exr.attributes.at(redistributed_attribute), R"({"guided":0.25})");
    record_redistributed(exr, {{Norm::l2, 0, 0, 1, 0, 0}});
    EXPECT_FALSE(exr.attributes.contains(redistributed_attribute));
}

TEST(PictureLayers, ReportTheirMemory) {
    const glm::ivec2 size(width, height);
    const ReconstructionLayers one{{Norm::l2}}, two{{Norm::l2, Norm::none}};
    RenderSettings gpr, pt;
    gpr.method = Method::gpr;
    gpr.basis = Basis::none;
    pt.method = Method::pt;
    EXPECT_GT(bytes_for_layers(size, gpr, one, 1), bytes_for_layers(size, pt, one, 1));
    EXPECT_GE(bytes_for_layers(size, gpr, {{Norm::none, Norm::l2}}, 1),
              bytes_for_layers(size, gpr, one, 1) + sizeof(Rgb) * width * height);
    EXPECT_LE(bytes_for_layers(size, gpr, two, 1),
              bytes_for_layers(size, gpr, one, 1) + sizeof(Rgb) * width * height);
    RenderSettings albedo = gpr;
    albedo.basis = Basis::albedo;
    EXPECT_GE(bytes_for_layers(size, albedo, one, 1),
              bytes_for_layers(size, gpr, one, 1) + Demodulation::bytes_a_pixel * width * height);
}

} // namespace
} // namespace tessera
