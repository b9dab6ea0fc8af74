// The L2 reconstruction redistributes light and keeps its sum: gradients alone cannot change it, as borders are
// Neumann's.
#include "recon/reconstruct.h"
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

} // namespace

} // namespace tessera::test
