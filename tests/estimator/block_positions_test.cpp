// All base paths of a reuse set begin at the same position within their pixels, also at the border of a block.
// Each square of 8x8 blocks has its own position.
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(400, 6); // wide enough for blocks with different positions
constexpr int row = 3;

/// Renders one pass of a floor under a point light. The radiance of a pixel is a smooth function of the position.
GradientImages one_pass(Method method, int seed, float aperture_radius = 0) {
    SceneBuilder b;
    b.quad({-20, 0, -20}, {0, 0, 40}, {40, 0, 0}, b.diffuse(Rgb(0.5f)));
    b.point({{3, 4, -2}, Rgb(50)});
    Camera camera{look_at({0, 6, 6}, {0, 0, 0}), 50, FovAxis::x};
    camera.aperture_radius = aperture_radius;
    camera.focus_distance = 4; // half the distance of the floor
    b.camera(camera);
    RenderSettings settings;
    settings.method = method;
    settings.max_depth = 2;
    settings.roulette = RouletteKind::none;
    settings.adapt_tile = false; // it would switch path reuse off where there is no noise
    settings.seed = static_cast<std::uint64_t>(seed);
    const auto scene = b.build();
    Render render(scene, scene->camera(), size, settings);
    ThreadPool pool(1);
    render.pass(pool);
    return render.images();
}

double luminance_at(const RgbImage& image, int x) {
    return luminance(image(x, row));
}

void expect_smooth_gradients(Method method, float aperture_radius = 0) {
    double largest_step = 0; // largest error of a primal's difference, relative to the largest gradient
    for (int seed = 0; seed < 8; ++seed) {
        const GradientImages images = one_pass(method, seed, aperture_radius);
        double largest = 0, bend = 0;
        for (int x = 1; x + 2 < size.x; ++x) {
            const double before = luminance_at(images.dx, x - 1), here = luminance_at(images.dx, x),
                         after = luminance_at(images.dx, x + 1);
            largest = std::max(largest, std::abs(here));
            bend = std::max(bend, std::abs(here - 0.5 * (before + after)));
            const double step = luminance_at(images.primal, x + 1) - luminance_at(images.primal, x);
            largest_step = std::max(largest_step, std::abs(step - here) / largest);
        }
        EXPECT_LT(bend, 0.1 * largest) << "seed " << seed;
    }
    EXPECT_GT(largest_step, 0.3) << "all blocks have the same position";
}

TEST(BlockPositions, GradientsAreSmoothAcrossBordersOfBlocks) {
    expect_smooth_gradients(Method::gpt);
    expect_smooth_gradients(Method::gpr);
}

TEST(BlockPositions, GradientsAreSmoothWithALens) {
    expect_smooth_gradients(Method::gpt, 0.1f);
    expect_smooth_gradients(Method::gpr, 0.1f);
}

TEST(BlockPositions, DifferBetweenSeeds) {
    const GradientImages a = one_pass(Method::pt, 1), b = one_pass(Method::pt, 2);
    int same = 0;
    for (int x = 0; x < size.x; ++x)
        same += luminance_at(a.primal, x) == luminance_at(b.primal, x);
    EXPECT_LT(same, size.x / 4);
}

} // namespace

} // namespace tessera::test
