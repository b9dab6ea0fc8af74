// Edges of directly visible lamps: where the film finds them, and that more rays there reduce noise.
// judge_test.cpp shows that they add no bias.
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Returns a scene of one tilted lamp at half of the focus distance.
std::shared_ptr<const Scene> lamp_in_the_dark(float aperture_radius = 0) {
    SceneBuilder b;
    b.quad({-0.5f, -0.4f, 0}, {1, 0.1f, 0}, {-0.1f, 0.9f, 0}, b.diffuse(Rgb(0.5f)),
           b.light(Texture(Rgb(3, 2, 1))));
    Camera camera{look_at({0, 0, 3}, {0, 0, 0}), 40, FovAxis::x};
    camera.aperture_radius = aperture_radius;
    camera.focus_distance = 6;
    b.camera(camera);
    return b.build();
}

RgbImage very_direct(bool edge_rays, int passes, std::uint64_t seed, float aperture_radius) {
    const auto scene = lamp_in_the_dark(aperture_radius);
    RenderSettings settings;
    settings.method = Method::pt;
    settings.max_depth = 1;
    settings.edge_rays = edge_rays;
    settings.seed = seed;
    Render render(scene, scene->camera(), {24, 24}, settings);
    ThreadPool pool(1);
    for (int pass = 0; pass < passes; ++pass)
        render.pass(pool);
    return render.images().very_direct;
}

double squared_error(bool edge_rays, int passes, const RgbImage& truth, float aperture_radius) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const RgbImage image = very_direct(edge_rays, passes, seed, aperture_radius);
        for (std::size_t i = 0; i < image.size(); ++i) {
            const Rgb d = image.data()[i] - truth.data()[i];
            sum += glm::dot(d, d);
        }
    }
    return sum;
}

TEST(LampEdges, HaveLessNoiseFromTheFirstPassOn) {
    for (const float aperture_radius : {0.0f, 0.3f}) {
        const RgbImage truth = very_direct(true, 4000, 99, aperture_radius);
        for (const int passes : {1, 16})
            EXPECT_LT(6 * squared_error(true, passes, truth, aperture_radius),
                      squared_error(false, passes, truth, aperture_radius))
                << passes << " passes, radius " << aperture_radius;
    }
}

TEST(LampEdges, IncludeThePixelsOnBothSides) {
    Film film(5, 3, {.lamp_edges = true});
    EXPECT_FALSE(film.has_lamp_edge(2, 1));
    RgbImage emission(7, 5, Rgb(1)); // one more pixel on all sides
    emission(3, 2) = Rgb(1.01f);     // too small a step for an edge
    film.find_lamp_edges(emission);
    EXPECT_FALSE(film.has_lamp_edge(2, 1));
    emission(5, 1) = Rgb(0);
    film.find_lamp_edges(emission);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x)
            EXPECT_EQ(film.has_lamp_edge(x, y), x >= 3 && y <= 1) << x << ',' << y;
    emission(2, 4) = Rgb(0); // below the film
    film.find_lamp_edges(emission);
    for (int x = 0; x < 3; ++x)
        EXPECT_TRUE(film.has_lamp_edge(x, 2)) << x;
}

/// The lamp covers three tenths of the first row, and no ray through the centre of a pixel hits it.
TEST(LampEdges, AreFoundInTheOutermostPixels) {
    SceneBuilder b;
    b.quad({-2, 0.9625f, 0}, {4, 0, 0}, {0, 1, 0}, b.diffuse(Rgb(0.5f)), b.light(Texture(Rgb(1))));
    b.camera(Camera{look_at({0, 0, 1}, {0, 0, 0}), 90, FovAxis::x}); // sees [-1, 1] in 16 pixels
    const auto scene = b.build();
    RenderSettings settings;
    settings.method = Method::pt;
    settings.max_depth = 1;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        settings.seed = seed;
        Render render(scene, scene->camera(), {16, 16}, settings);
        ThreadPool pool(1);
        for (const int rays : {16, 64}) { // after 1 and 4 passes; each ray has its own row
            while (render.spp() * edge_emitter_rays < rays)
                render.pass(pool);
            const RgbImage image = render.images().very_direct;
            for (int x = 0; x < 16; ++x)
                EXPECT_NEAR(image(x, 0).r, 0.3f, 1 / static_cast<float>(rays) + 1e-4f) << x;
        }
    }
}

/// A mask in front of a lamp lets rays through at random, so all pixels count as edges.
TEST(LampEdges, AreEverywhereBehindMasks) {
    constexpr float opacity = 0.84f;
    SceneBuilder b;
    b.quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, b.diffuse(Rgb(0.5f)), b.light(Texture(Rgb(1))));
    Material mask;
    mask.opacity = Texture(Rgb(opacity));
    b.quad({-4, -4, 1}, {8, 0, 0}, {0, 8, 0}, b.material(mask));
    b.camera({0, 0, 3}, {0, 0, 0}, 40);
    const auto scene = b.build();
    RenderSettings settings;
    settings.method = Method::pt;
    settings.max_depth = 1;
    Render render(scene, scene->camera(), {64, 64}, settings);
    ThreadPool pool(1);
    constexpr int passes = 16;
    for (int pass = 0; pass < passes; ++pass)
        render.pass(pool);
    const RgbImage image = render.images().very_direct;
    double squares = 0;
    for (Rgb pixel : image)
        squares += std::pow(static_cast<double>(pixel.g + opacity - 1), 2);
    const double variance_of_one_ray = static_cast<double>(opacity * (1 - opacity)) / passes;
    EXPECT_LT(squares / static_cast<double>(image.size()), variance_of_one_ray / 12);
}

/// A lamp in a mirror is directly visible emission with more rays at its edges.
TEST(LampEdges, AreFoundInMirrors) {
    SceneBuilder b;
    b.quad({-0.5f, -0.4f, 5}, {-0.1f, 0.9f, 0}, {1, 0.1f, 0}, b.diffuse(Rgb(0.5f)),
           b.light(Texture(Rgb(3, 2, 1))));
    b.quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, b.mirror());
    b.camera({0, 0, 3}, {0, 0, 0}, 40);
    const auto scene = b.build();
    RenderSettings settings;
    settings.max_depth = 2;
    for (const Method method : {Method::pt, Method::gpr}) {
        settings.method = method;
        Render render(scene, scene->camera(), {24, 24}, settings);
        ThreadPool pool(1);
        render.pass(pool);
        const GradientImages images = render.images();
        const auto is_lit = [](Rgb c) { return c != Rgb(0); };
        EXPECT_GT(std::ranges::count_if(images.very_direct, is_lit), 10);
        EXPECT_TRUE(std::ranges::none_of(images.radiance(), is_lit))
            << "the mirror shows directly visible emission only";
        settings.edge_rays = false;
        Render plain(scene, scene->camera(), {24, 24}, settings);
        plain.pass(pool);
        settings.edge_rays = true;
        EXPECT_GT(render.counters().rays[static_cast<std::size_t>(RayKind::bounce)],
                  plain.counters().rays[static_cast<std::size_t>(RayKind::bounce)]);
    }
}

/// Each sample contains all directly visible emission in a mirror, with any roulette on path length.
TEST(LampEdges, MirrorsTakeNoRoulette) {
    SceneBuilder b;
    b.quad({-2, -1.6f, 5}, {-0.4f, 3.6f, 0}, {4, 0.4f, 0}, b.diffuse(Rgb(0.5f)), b.light(Texture(Rgb(3, 2, 1))));
    b.quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, b.mirror());
    b.camera({0, 0, 3}, {0, 0, 0}, 40);
    RenderSettings settings;
    settings.method = Method::pt;
    settings.roulette_depth = 1;
    settings.edge_rays = false;
    const auto scene = b.build();
    Render render(scene, scene->camera(), {24, 24}, settings);
    ThreadPool pool(1);
    for (int pass = 0; pass < 8; ++pass)
        render.pass(pool);
    const RgbImage image = render.images().very_direct;
    for (int y = 10; y < 14; ++y)
        for (int x = 10; x < 14; ++x)
            EXPECT_LT(glm::distance(image(x, y), Rgb(3, 2, 1)), 1e-4f) << x << ',' << y;
}

/// Pixels in the middle of a lamp need no further rays.
TEST(LampEdges, TakeMoreRaysOnlyAtEdges) {
    const auto camera_rays = [](bool edge_rays) {
        static const auto scene = lamp_in_the_dark();
        RenderSettings settings;
        settings.method = Method::pt;
        settings.max_depth = 1;
        settings.edge_rays = edge_rays;
        Render render(scene, scene->camera(), {24, 24}, settings);
        ThreadPool pool(1);
        for (int pass = 0; pass < 4; ++pass)
            render.pass(pool);
        return render.counters().rays[static_cast<std::size_t>(RayKind::camera)];
    };
    const auto plain = camera_rays(false), everywhere = plain * 17;
    EXPECT_EQ(plain, 4u * 24 * 24);
    EXPECT_GT(camera_rays(true), plain);
    EXPECT_LT(camera_rays(true), everywhere / 2);
}

} // namespace

} // namespace tessera::test
