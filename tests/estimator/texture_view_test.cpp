// Filtered textures in pictures: they keep the mean, and take the noise of what is small.
#include "render/run/render.h"
#include "tests/support/scene_builder.h"

#include <cmath>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

Texture squares(float many, Rgb color0, Rgb color1) {
    Texture t;
    t.kind = CheckerboardTexture{color0, color1};
    t.to_uv = glm::mat3(many, 0, 0, 0, many, 0, 0, 0, 1);
    return t;
}

/// A plain that shines in proportion to its albedo, in even light, to the horizon; `mirror`: seen in one.
std::shared_ptr<const Scene> plain(const Texture& reflectance, bool mirror) {
    SceneBuilder b;
    const int floor = b.material({"floor", DiffuseMaterial{reflectance}});
    b.quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, floor);
    b.environment(std::vector<Rgb>(2, Rgb(1)), 2);
    if (mirror)
        b.quad({-2, -1, 0}, {4, 0, 0}, {0, 4, 0}, b.mirror());
    b.camera({0, 1, mirror ? 3.0f : 10.0f}, mirror ? glm::vec3(0, 1.3f, 0) : glm::vec3(0, 0, 0), 40);
    return b.build();
}

RgbImage picture(const std::shared_ptr<const Scene>& scene, TextureFilter filter, int passes,
                 Method method = Method::pt) {
    RenderSettings s;
    s.method = method;
    s.max_depth = 3;
    s.filter_textures = filter;
    Render render(scene, scene->camera(), {48, 36}, s);
    ThreadPool pool(2);
    for (int i = 0; i < passes; ++i)
        render.pass(pool);
    return render.images().radiance();
}

double mean(const RgbImage& image) {
    double sum = 0;
    for (const Rgb c : image)
        sum += double(c.g);
    return sum / double(image.size());
}

double squared_difference(const RgbImage& a, const RgbImage& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::pow(double(a.begin()[i].g) - double(b.begin()[i].g), 2);
    return sum / double(a.size());
}

class Filtered : public testing::TestWithParam<bool> {};

TEST_P(Filtered, TexturesKeepTheMeanAndLoseTheirNoise) {
    const auto scene = plain(squares(97, Rgb(0.9f), Rgb(0.1f)), GetParam());
    const RgbImage truth = picture(scene, TextureFilter::off, 3000);
    const double noise = squared_difference(picture(scene, TextureFilter::off, 8), truth);
    for (const TextureFilter filter : {TextureFilter::camera, TextureFilter::path}) {
        const RgbImage filtered = picture(scene, filter, 400);
        const double standard_error = std::sqrt(squared_difference(filtered, truth) / double(truth.size()));
        EXPECT_LT(standard_error, 4e-3 * mean(truth));
        EXPECT_NEAR(mean(filtered), mean(truth), 4 * standard_error);
        const double left = squared_difference(picture(scene, filter, 8), truth);
        // What is softer for it weighs on large squares; and the camera would see what is in the mirror from close
        // by.
        EXPECT_LT(left, (GetParam() && filter == TextureFilter::camera ? 0.9 : 0.65) * noise);
    }
}

INSTANTIATE_TEST_SUITE_P(plains, Filtered, testing::Bool());

TEST(Filtered, OneColourHasTheSameBits) {
    for (const bool mirror : {false, true}) {
        const auto scene = plain(squares(97, Rgb(0.6f), Rgb(0.6f)), mirror);
        for (const Method method : {Method::pt, Method::gpr}) {
            const RgbImage plain = picture(scene, TextureFilter::off, 2, method);
            for (const TextureFilter filter : {TextureFilter::camera, TextureFilter::path})
                EXPECT_EQ(squared_difference(plain, picture(scene, filter, 2, method)), 0);
        }
    }
}

} // namespace

} // namespace tessera::test
