// Feature samples of pixels: they follow mirrors, and their number depends on how features vary.
#include "render/film/pixel_features.h"
#include "render/run/render.h"
#include "tests/support/scene_builder.h"

#include <memory>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

/// Returns a scene in which a mirror, 3 units in front of the camera, shows a wall 2 units behind it. Pixels
/// beside the mirror see nothing.
std::shared_ptr<const Scene> room() {
    SceneBuilder scene;
    const int wall = scene.diffuse({0.6f, 0.3f, 0.1f});
    scene.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, scene.mirror());
    scene.quad({-20, -20, 5}, {0, 40, 0}, {40, 0, 0}, wall, scene.light(Rgb(1)));
    scene.camera({0, 0, 3}, {0, 0, 0}, 60);
    return scene.build();
}

TEST(PixelFeatures, FollowMirrors) {
    for (const Method method : all_methods) {
        const auto scene = room();
        RenderSettings settings;
        settings.method = method;
        Render render(scene, scene->camera(), {33, 33}, settings);
        ThreadPool pool(1);
        render.pass(pool);
        render.pass(pool);
        const GradientImages images = render.images();
        const FeatureImages& features = images.features;
        // The mirror absorbs a little of each colour.
        EXPECT_LT(glm::distance(features.albedo(16, 16), Rgb(0.6f, 0.3f, 0.1f)), 0.1f) << short_name(method);
        if (is_demodulated(settings)) {
            EXPECT_LT(glm::distance(features.albedo(16, 16), images.demodulation.albedo(16, 16)), 1e-6f);
            EXPECT_LT(glm::distance(features.albedo(16, 16), images.demodulation.sampled_albedo(16, 16)), 1e-6f);
        }
        EXPECT_NEAR(features.normal(16, 16).z, -1, 1e-4f);
        EXPECT_NEAR(features.nearness(16, 16), 1 / 8.0f, 1e-3f); // 3 to the mirror, 5 to the wall
        EXPECT_NEAR(features.roughness(16, 16), 1, 1e-4f);       // of the wall
        EXPECT_LT(glm::distance(features.albedo(0, 0), Rgb(1)), 1e-6f) << "a pixel beside the mirror sees nothing";
        EXPECT_EQ(features.normal(0, 0), Rgb(0));
        EXPECT_EQ(features.nearness(0, 0), 0);
    }
}

/// Renders one pass of the same scene with an evenly lit checkerboard on the wall. With `is_masked`, a mask that
/// few rays hit is in front of the mirror.
/// @param squares  of the checkerboard along each axis
GradientImages checkerboard_in_a_mirror(bool is_masked, float squares = 40,
                                        TextureFilter filter = TextureFilter::off, Method method = Method::gpr) {
    SceneBuilder scene;
    DiffuseMaterial checker;
    checker.reflectance.kind = CheckerboardTexture{Rgb(0.8f), Rgb(0.1f)};
    checker.reflectance.to_uv = glm::mat3(squares, 0, 0, 0, squares, 0, 0, 0, 1);
    scene.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, scene.mirror());
    scene.quad({-20, -20, 5}, {0, 40, 0}, {40, 0, 0}, scene.material({"checker", checker}));
    Material mask;
    mask.opacity = Texture(Rgb(1e-3f));
    if (is_masked)
        scene.quad({-1, -1, 4}, {0, 2, 0}, {2, 0, 0}, scene.material(mask));
    scene.directional({{0.6f, 0, -0.8f}, Rgb(1)}); // the shadow of the mirror is not visible in it
    scene.camera({0, 0, 3}, {0, 0, 0}, 30);
    RenderSettings settings;
    settings.method = method;
    settings.filter_textures = filter;
    settings.max_depth = 3; // no interreflection
    const auto built = scene.build();
    Render render(built, built->camera(), {33, 33}, settings);
    ThreadPool pool(1);
    render.pass(pool);
    return render.images();
}

/// Radiance in a mirror is divided by the albedo of the mirrored surface, so the coefficient is as smooth as where
/// the surface is seen directly. In scenes with masks, it is divided by the mirror's own albedo.
TEST(PixelFeatures, DivideMirroredLightByTheAlbedoBehindTheMirror) {
    const auto variation = [](const RgbImage& image) {
        double sum = 0, squares = 0;
        for (Rgb c : image) {
            sum += static_cast<double>(c.g);
            squares += static_cast<double>(c.g * c.g);
        }
        return squares * static_cast<double>(image.size()) / (sum * sum) - 1;
    };
    const GradientImages clear = checkerboard_in_a_mirror(false), masked = checkerboard_in_a_mirror(true);
    EXPECT_LT(variation(clear.primal), 1e-5);
    EXPECT_GT(variation(clear.radiance()), 0.1);
    EXPECT_GT(variation(masked.primal), 0.1);
}

/// With demodulation, textures in mirrors are not filtered, as those at x_1. PT has no demodulation: its feature
/// samples see the mean colour of squares much smaller than a pixel.
TEST(PixelFeatures, FilterTexturesInMirrorsAsPathsDo) {
    const Demodulation plain = checkerboard_in_a_mirror(false).demodulation;
    for (const TextureFilter filter : {TextureFilter::camera, TextureFilter::path}) {
        const Demodulation filtered = checkerboard_in_a_mirror(false, 40, filter).demodulation;
        const FeatureImages of_pt = checkerboard_in_a_mirror(false, 20000, filter, Method::pt).features;
        for (int x = 12; x < 21; ++x) {
            EXPECT_EQ(filtered.sampled_albedo(x, 16), plain.sampled_albedo(x, 16));
            EXPECT_EQ(filtered.albedo(x, 16), plain.albedo(x, 16));
            EXPECT_NEAR(of_pt.albedo(x, 16).g, 0.45f, 0.02f);
        }
    }
}

/// Two mirrors that face each other: rays to the wall are reflected ten times.
TEST(PixelFeatures, FollowMirrorsToTheDepthOfPaths) {
    SceneBuilder scene;
    const int mirror = scene.mirror();
    scene.quad({1, -1, 0}, {0, 2, 0}, {0, 0, -20}, mirror);
    scene.quad({-1, -1, -20}, {0, 2, 0}, {0, 0, 20}, mirror);
    scene.quad({-1, -1, -20.5f}, {2, 0, 0}, {0, 2, 0}, scene.diffuse({0.6f, 0.3f, 0.1f}), scene.light(Rgb(1)));
    scene.camera({0, 0, 0}, {1, 0, -1}, 0.5f);
    const auto built = scene.build();
    for (const int depth : {8, 14}) {
        RenderSettings settings;
        settings.method = Method::gpr;
        settings.max_depth = depth;
        Render render(built, built->camera(), {5, 5}, settings);
        ThreadPool pool(1);
        render.pass(pool);
        const Demodulation d = render.images().demodulation;
        EXPECT_EQ(d.albedo(2, 2), d.sampled_albedo(2, 2));
        EXPECT_EQ(d.albedo(2, 2).r > 0.01f, depth == 14) << "only paths of depth 14 reach the wall";
    }
}

/// Pixels that see one surface need few feature samples, and pixels at an edge more.
TEST(PixelFeatures, TakeMoreSamplesWherePixelsSeeSeveralSurfaces) {
    PixelFeatures features(9, 9, true);
    const auto pass = [&](int index) {
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 9; ++x)
                for (int wanted = features.wanted(x, y); wanted > 0; --wanted) {
                    const bool is_right = x > 4 || (x == 4 && features.count(x, y) % 2 == 0);
                    features.add(x, y, {Rgb(0.5f), {Rgb(0.5f), is_right ? Rgb(0, 0, 1) : Rgb(1, 0, 0), 1}});
                }
        features.request_more(index + 1);
    };
    for (int i = 0; i < 10; ++i)
        pass(i);
    EXPECT_EQ(features.count(0, 0), 4);
    EXPECT_EQ(features.count(8, 8), 4);
    EXPECT_GT(features.count(4, 4), 20);
    EXPECT_LT(features.count(4, 4), 100);
    EXPECT_NEAR(features.images().normal(4, 4).z, 0.5f, 0.05f);
}

} // namespace
} // namespace tessera::test
