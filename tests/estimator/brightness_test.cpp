// Energy of reconstructions: `l2` keeps the mean, because the gradients have Neumann boundary conditions, and
// pixels that see nothing stay black.
#include "recon/picture/reconstruct.h"
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

glm::dvec3 mean(const RgbImage& image) {
    glm::dvec3 sum(0);
    for (const Rgb c : image)
        sum += glm::dvec3(c);
    return sum / double(image.size());
}

TEST(Brightness, L2KeepsTheMeanOfThePrimal) {
    for (const TestScene& t : all_test_scenes()) {
        if (t.name != "diffuse" && t.name != "patchwork_half_vectors" && t.name != "environment_gloss")
            continue;
        for (const Method method : {Method::gpt, Method::gpr})
            for (const glm::ivec2 size : {glm::ivec2(37, 23), glm::ivec2(5, 3), glm::ivec2(1, 1)}) {
                RenderSettings settings;
                settings.method = method;
                settings.basis = Basis::none;
                settings.max_depth = t.max_depth;
                settings.shift_threshold = t.shift_threshold;
                settings.shift_distance = t.shift_distance;
                settings.seed = 8;
                Render render(t.scene, t.scene->camera(), size, settings);
                ThreadPool pool(2);
                for (int pass = 0; pass < 4; ++pass)
                    render.pass(pool);
                const GradientImages images = render.images();
                const Reconstruction r = reconstruct(images, {Norm::l2, 0.2f});
                const glm::dvec3 expected = mean(images.radiance()) + mean(images.very_direct);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(mean(r.image)[c] / expected[c], 1, 1e-5)
                        << t.name << ' ' << short_name(method) << ' ' << size.x << 'x' << size.y;
            }
    }
}

TEST(Brightness, PixelsThatSeeNothingStayBlack) {
    SceneBuilder builder;
    const int white = builder.diffuse(Rgb(0.7f));
    builder.sphere({-0.4f, 0, 0}, 0.4f, white);
    builder.sphere({0.5f, 0.1f, 0}, 0.3f, builder.conductor(0.1f));
    builder.quad({-0.1f, 0.9f, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f}, white, builder.light(Rgb(30)));
    builder.camera({0, 0, 4}, {0, 0, 0}, 40);
    const auto scene = builder.build();
    ThreadPool pool(2);
    for (const Method method : {Method::pt, Method::pr, Method::gpt, Method::gpr}) {
        RenderSettings settings;
        settings.method = method;
        Render render(scene, scene->camera(), {60, 45}, settings);
        for (int pass = 0; pass < 6; ++pass)
            render.pass(pool);
        const GradientImages images = render.images();
        for (const Norm norm : {Norm::none, Norm::smoothed, Norm::weighted, Norm::guided}) {
            if (reconstructs_components(norm) && !images.has_gradients())
                continue;
            const RgbImage picture = reconstruct(images, {.norm = norm}).image;
            int pixels_without_surface = 0;
            for (std::size_t i = 0; i < picture.size(); ++i)
                if (images.features.nearness.data()[i] == 0 && is_black(images.radiance().data()[i])) {
                    ++pixels_without_surface;
                    EXPECT_EQ(picture.data()[i], images.very_direct.data()[i]) << short_name(method);
                }
            EXPECT_GT(pixels_without_surface, 1000);
        }
    }
}

} // namespace

} // namespace tessera::test
