// Crop windows have the samples of the whole film.
#include "render/estimator/pass.h"
#include "render/run/render.h"
#include "tests/support/scene_builder.h"

#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr CropWindow window{{50, 40}, {13, 9}, {21, 18}};

std::shared_ptr<const Scene> scene_of(const CropWindow& crop) {
    SceneBuilder b;
    const int grey = b.diffuse(Rgb(0.6f));
    b.room({grey, grey, grey, b.diffuse(Rgb(0.7f, 0.1f, 0.1f)), grey});
    b.sphere({0.2f, -0.4f, 0}, 0.4f, b.mirror());
    b.environment(std::vector<Rgb>(8, Rgb(1)), 4);
    Camera camera{look_at({0, 0, 4}, {0, 0, 0}), 40};
    camera.aperture_radius = 0.05f;
    camera.focus_distance = 4;
    camera.principal_offset = {0.05f, -0.02f};
    camera.crop = crop;
    b.camera(camera);
    return b.build();
}

TEST(CropWindow, RaysAreThoseOfTheWholeFilm) {
    const Camera whole = scene_of({})->camera(), part = scene_of(window)->camera();
    const Projection a(whole, window.film), b(part, window.size);
    const Ray of_whole = a.ray({13 + 3.25f, 9 + 7.5f}, {0.3f, -0.2f}),
              of_part = b.ray({3.25f, 7.5f}, {0.3f, -0.2f});
    EXPECT_EQ(of_whole.direction, of_part.direction);
    EXPECT_EQ(of_whole.origin, of_part.origin);
    const glm::vec4 seen = b.project(of_part.origin + 3.0f * of_part.direction, {0.3f, -0.2f});
    EXPECT_NEAR(seen.x / seen.w, 3.25f, 1e-3f);
    EXPECT_NEAR(seen.y / seen.w, 7.5f, 1e-3f);
    EXPECT_EQ(b.pixel_width().angle, a.pixel_width().angle);
}

TEST(CropWindow, ScalesWithThePicture) {
    const Camera part = scene_of(window)->camera();
    const Projection small(part, window.size), large(part, 2 * window.size);
    const glm::vec3 a = small.ray({3, 5}).direction, b = large.ray({6, 10}).direction;
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(a[i], b[i], 1e-6f);
    EXPECT_EQ(window.size_on({100, 80}), glm::ivec2(42, 36));
    EXPECT_EQ(CropWindow{}.size_on({100, 80}), glm::ivec2(100, 80));
}

TEST(CropWindow, PathTracingHasTheSamplesOfTheWholeFilm) {
    RenderSettings s;
    s.method = Method::pt;
    s.path_guiding = Guiding::off;
    s.max_depth = 4;
    ThreadPool pool(2);
    const auto picture = [&](const CropWindow& crop, glm::ivec2 size) {
        const auto scene = scene_of(crop);
        Render render(scene, scene->camera(), size, s);
        for (int pass = 0; pass < 3; ++pass)
            render.pass(pool);
        return render.images();
    };
    const GradientImages whole = picture({}, window.film), part = picture(window, window.size);
    for (int y = 1; y + 1 < window.size.y; ++y) // the film looks for edges of lamps in its own pixels only
        for (int x = 1; x + 1 < window.size.x; ++x) {
            // Positions on the film are sums of floats in another order.
            ASSERT_NEAR(part.primal(x, y).g, whole.primal(13 + x, 9 + y).g, 1e-4f) << x << ", " << y;
            ASSERT_NEAR(part.very_direct(x, y).g, whole.very_direct(13 + x, 9 + y).g, 1e-4f) << x << ", " << y;
        }
}

TEST(CropWindow, TilesAndBlocksAreThoseOfTheWholeFilm) {
    const auto whole = scene_of({}), part = scene_of(window);
    for (const Method method : all_methods) {
        RenderSettings s;
        s.method = method;
        s.seed = 5;
        for (int index = 0; index < 12; ++index) {
            const LearnedReuse of_whole(window.film, s), of_part(window.size, s);
            const Pass a(*whole, whole->camera(), window.film, s, of_whole, index),
                b(*part, part->camera(), window.size, s, of_part, index);
            for (const glm::ivec2 p : {glm::ivec2(0, 0), glm::ivec2(20, 17), glm::ivec2(4, 11)}) {
                const glm::ivec2 q = p + window.offset;
                EXPECT_EQ(a.camera_sample(q).subpixel, b.camera_sample(p).subpixel);
                EXPECT_EQ(a.sample_at(1, q, 0).lens, b.sample_at(1, p, 0).lens);
                EXPECT_EQ(a.turn(q), b.turn(p));
                EXPECT_EQ(a.random(q.x, q.y).draw(1, Draw::lobe), b.random(p.x, p.y).draw(1, Draw::lobe));
                const PixelRect tile = a.grid.tile_at(q), same = b.grid.tile_at(p);
                EXPECT_EQ(tile.x0, same.x0 + window.offset.x);
                EXPECT_EQ(tile.y0, same.y0 + window.offset.y);
            }
            EXPECT_LE(blocks_of(b).size(), most_blocks(window.size, s));
            int pixels = 0;
            for (const PixelRect& block : blocks_of(b)) {
                const PixelRect inside = block.clipped(window.size);
                pixels += inside.width() * inside.height();
            }
            EXPECT_EQ(pixels, window.size.x * window.size.y);
        }
    }
}

} // namespace

} // namespace tessera::test
