// Pictures with filtered textures: the mean stays, and the noise of small details falls.
#include "render/run/render.h"
#include "tests/support/scene_builder.h"

#include <cmath>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

Texture checkerboard(float squares, Rgb color0, Rgb color1) {
    Texture t;
    t.kind = CheckerboardTexture{color0, color1};
    t.to_uv = glm::mat3(squares, 0, 0, 0, squares, 0, 0, 0, 1);
    return t;
}

/// Returns a scene of a plain up to the horizon under a uniform sky, so that radiance is proportional to albedo.
/// @param mirror  the camera sees the plain in a mirror
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
    const auto scene = plain(checkerboard(97, Rgb(0.9f), Rgb(0.1f)), GetParam());
    const RgbImage truth = picture(scene, TextureFilter::off, 3000);
    const double noise = squared_difference(picture(scene, TextureFilter::off, 8), truth);
    for (const TextureFilter filter : {TextureFilter::camera, TextureFilter::path}) {
        const RgbImage filtered = picture(scene, filter, 1500);
        const double standard_error = std::sqrt(squared_difference(filtered, truth) / double(truth.size()));
        EXPECT_LT(standard_error, 2e-3 * mean(truth));
        EXPECT_NEAR(mean(filtered), mean(truth), 4 * standard_error);
        const double error = squared_difference(picture(scene, filter, 8), truth);
        // Filtering blurs the edges of large squares, so some error remains. TextureFilter::camera filters less in
        // a mirror: the reflected floor is close to the camera.
        EXPECT_LT(error, (GetParam() && filter == TextureFilter::camera ? 0.9 : 0.65) * noise);
    }
}

INSTANTIATE_TEST_SUITE_P(plains, Filtered, testing::Bool());

TEST(Filtered, OneColourHasTheSameBits) {
    for (const bool mirror : {false, true}) {
        const auto scene = plain(checkerboard(97, Rgb(0.6f), Rgb(0.6f)), mirror);
        for (const Method method : {Method::pt, Method::gpr}) {
            const RgbImage plain = picture(scene, TextureFilter::off, 2, method);
            for (const TextureFilter filter : {TextureFilter::camera, TextureFilter::path})
                EXPECT_EQ(squared_difference(plain, picture(scene, filter, 2, method)), 0);
        }
    }
}

} // namespace

} // namespace tessera::test
