// Alpha: the covered fraction of pixels, with emitters that the camera does not see.
#include "render/run/render.h"
#include "tests/support/scene_builder.h"

#include <glm/vec2.hpp>
#include <algorithm>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(16, 12);
constexpr float edge = 0.29f; ///< of the wall, in half widths of the picture to the right

/// Returns a wall on the left under a sky, seen in parallel, with a lamp in front of everything.
std::shared_ptr<const Scene> wall_and_lamp(bool hides_emitters, bool has_sky) {
    SceneBuilder b;
    b.quad({-9, -9, 0}, {9 + edge, 0, 0}, {0, 18, 0}, b.diffuse(Rgb(0.5f)));
    b.quad({-0.5f, -0.5f, 1}, {1, 0, 0}, {0, 1, 0}, b.diffuse(Rgb(0)), b.light(Texture{Rgb(7)}));
    if (has_sky)
        b.environment(std::vector<Rgb>(8, Rgb(1)), 4);
    Camera camera{look_at({0, 0, 4}, {0, 0, 0})};
    camera.is_orthographic = true;
    b.camera(camera);
    SceneDescription description = b.build()->description();
    description.hides_emitters = hides_emitters;
    return std::make_shared<const Scene>(description);
}

struct Picture {
    Image<float> alpha;
    GradientImages images;
};

Picture render(const std::shared_ptr<const Scene>& scene, Method method) {
    RenderSettings s;
    s.method = method;
    s.max_depth = 2;
    ThreadPool pool(2);
    Render render(scene, scene->camera(), size, s);
    for (int pass = 0; pass < 64; ++pass)
        render.pass(pool);
    return {render.coverage(), render.images()};
}

/// Returns the fraction of column x that the wall covers.
float covered(int x) {
    const float end = size.x * (1 + edge) / 2;
    return std::clamp(end - static_cast<float>(x), 0.0f, 1.0f);
}

TEST(Alpha, IsTheCoveredAreaOfEachPixel) {
    for (const Method method : all_methods) {
        const Picture hidden = render(wall_and_lamp(true, true), method);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                ASSERT_NEAR(hidden.alpha(x, y), covered(x), 0.05f) << short_name(method) << " " << x << ", " << y;
    }
}

TEST(Alpha, HiddenEmittersCastLightAndAreNotSeen) {
    const Picture hidden = render(wall_and_lamp(true, true), Method::gpr);
    float brightest = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            brightest = std::max(brightest, hidden.images.very_direct(x, y).r);
            if (covered(x) == 1) {
                EXPECT_GT(hidden.images.radiance()(x, y).r, 0.1f) << "the wall behind the lamp is lit and seen";
            } else if (covered(x) == 0) {
                EXPECT_EQ(hidden.images.radiance()(x, y).r, 0);
            }
        }
    EXPECT_EQ(brightest, 0);
}

TEST(Alpha, VisibleEmittersAndSkiesCover) {
    const Picture sky = render(wall_and_lamp(false, true), Method::pt),
                  none = render(wall_and_lamp(false, false), Method::pt);
    EXPECT_EQ(*std::ranges::min_element(sky.alpha), 1);
    EXPECT_EQ(sky.images.very_direct(size.x - 1, 0).r, 1);
    EXPECT_EQ(none.alpha(size.x - 1, 0), 0) << "without a sky nothing is seen there";
    EXPECT_EQ(none.alpha(8, 6), 1);
    EXPECT_EQ(none.images.very_direct(8, 6).r, 7);
}

} // namespace

} // namespace tessera::test
