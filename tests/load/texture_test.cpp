#include "render/surface/texture.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace tessera {

namespace {

/// Returns a linear grey bitmap of 2 x 2 pixels: 0 1 in the upper row, 2 3 in the lower row.
Texture two_by_two(Filter filter, Wrap wrap) {
    auto bitmap = std::make_shared<Bitmap>();
    bitmap->width = 2;
    bitmap->height = 2;
    bitmap->srgb = false;
    bitmap->floats = {Rgb(0), Rgb(1), Rgb(2), Rgb(3)};
    Texture texture;
    texture.kind = BitmapTexture{bitmap, filter, wrap};
    return texture;
}

float at(const Texture& texture, float u, float v) {
    return texture.evaluate({{u, v}}).g;
}

/// A number from a checkerboard has the value of Mitsuba's eval(). The eval_1() of Mitsuba 3.9 exchanges the two.
TEST(Texture, CheckerboardsAsNumbersFollowEval) {
    Texture texture;
    texture.kind = CheckerboardTexture{Rgb(0.25f), Rgb(0.75f)};
    EXPECT_FLOAT_EQ(texture.scalar(glm::vec2(0.2f, 0.2f)), 0.25f);
    EXPECT_FLOAT_EQ(texture.scalar(glm::vec2(0.2f, 0.7f)), 0.75f);
    EXPECT_FLOAT_EQ(texture.scalar(glm::vec2(0.7f, 0.7f)), 0.25f);
}

TEST(Texture, GradientIsTheDerivative) {
    Bitmap bitmap;
    bitmap.width = 5;
    bitmap.height = 4;
    for (int i = 0; i < 20; ++i)
        bitmap.floats.emplace_back(0.1f * static_cast<float>((7 * i) % 11));
    Texture texture;
    texture.to_uv = {1.5f, 0.4f, 0, -0.3f, 2, 0, 0.1f, 0.2f, 1};
    texture.scale = 3;
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
        texture.kind = BitmapTexture{std::make_shared<const Bitmap>(bitmap), Filter::bilinear, wrap};
        for (const glm::vec2 uv : {glm::vec2(0.31f, 0.17f), glm::vec2(1.03f, -0.41f), glm::vec2(-0.77f, 1.63f)}) {
            constexpr float h = 1e-3f;
            const auto value = [&](float u, float v) { return luminance(texture.evaluate({{u, v}})); };
            const glm::vec2 gradient = texture.gradient({uv});
            EXPECT_NEAR(gradient.x, (value(uv.x + h, uv.y) - value(uv.x - h, uv.y)) / (2 * h), 0.02f);
            EXPECT_NEAR(gradient.y, (value(uv.x, uv.y + h) - value(uv.x, uv.y - h)) / (2 * h), 0.02f);
        }
    }
}

} // namespace

TEST(Texture, DecodesSrgbBytes) {
    Bitmap bitmap{1, 2, true, {0, 128, 255, 10, 20, 30}, {}};
    EXPECT_EQ(bitmap.texel(0, 0).r, 0);
    EXPECT_NEAR(bitmap.texel(0, 0).g, 0.2158605f, 1e-6);
    EXPECT_EQ(bitmap.texel(0, 0).b, 1);
    EXPECT_NEAR(bitmap.texel(0, 1).r, 10 / 255.0 / 12.92, 1e-7); // the linear segment of sRGB
    bitmap.srgb = false;
    EXPECT_FLOAT_EQ(bitmap.texel(0, 1).b, 30 / 255.0f);
}

TEST(Texture, NearestFilterBeginsAtTheTopLeft) {
    const Texture texture = two_by_two(Filter::nearest, Wrap::repeat);
    EXPECT_EQ(at(texture, 0.1f, 0.1f), 0);
    EXPECT_EQ(at(texture, 0.9f, 0.1f), 1);
    EXPECT_EQ(at(texture, 0.1f, 0.9f), 2);
    EXPECT_EQ(at(texture, 1.9f, -0.1f), 3);
}

TEST(Texture, BilinearIsExactAtPixelCentres) {
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
        const Texture texture = two_by_two(Filter::bilinear, wrap);
        EXPECT_FLOAT_EQ(at(texture, 0.25f, 0.25f), 0);
        EXPECT_FLOAT_EQ(at(texture, 0.75f, 0.25f), 1);
        EXPECT_FLOAT_EQ(at(texture, 0.25f, 0.75f), 2);
        EXPECT_FLOAT_EQ(at(texture, 0.5f, 0.5f), 1.5f);
        EXPECT_FLOAT_EQ(at(texture, 0.375f, 0.25f), 0.25f);
    }
}

TEST(Texture, WrapModes) {
    const Texture repeat = two_by_two(Filter::bilinear, Wrap::repeat);
    EXPECT_FLOAT_EQ(at(repeat, 0, 0.25f), 0.5f); // between the last and the first column
    EXPECT_FLOAT_EQ(at(repeat, 1, 0.25f), 0.5f);
    EXPECT_FLOAT_EQ(at(repeat, -3.25f, 5.25f), 1);
    const Texture clamp = two_by_two(Filter::bilinear, Wrap::clamp);
    EXPECT_FLOAT_EQ(at(clamp, 0, 0.25f), 0);
    EXPECT_FLOAT_EQ(at(clamp, 7, 0.25f), 1);
    const Texture mirror = two_by_two(Filter::bilinear, Wrap::mirror);
    EXPECT_FLOAT_EQ(at(mirror, 1, 0.25f), 1);
    EXPECT_FLOAT_EQ(at(mirror, 1.25f, 0.25f), 1);
    EXPECT_FLOAT_EQ(at(mirror, -0.75f, 0.25f), 1);
}

TEST(Texture, AnyCoordinateGivesAValueInRange) {
    const float values[] = {std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN(),
                            1e30f,
                            -1e30f,
                            -1e-30f,
                            std::nextafter(1.0f, 0.0f),
                            std::nextafter(0.0f, -1.0f)};
    for (const Filter filter : {Filter::nearest, Filter::bilinear})
        for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
            for (const float u : values)
                for (const float v : values) {
                    const float value = at(two_by_two(filter, wrap), u, v);
                    EXPECT_TRUE(value >= 0 && value <= 3) << u << " " << v;
                }
}

TEST(Texture, Checkerboard) {
    Texture texture;
    texture.kind = CheckerboardTexture{Rgb(0.8f), Rgb(0.2f)};
    EXPECT_EQ(at(texture, 0.2f, 0.2f), 0.8f);
    EXPECT_EQ(at(texture, 0.7f, 0.2f), 0.2f);
    EXPECT_EQ(at(texture, 0.2f, 0.7f), 0.2f);
    EXPECT_EQ(at(texture, -0.3f, -0.3f), 0.8f);
    texture.to_uv[0][0] = 2;
    EXPECT_EQ(at(texture, 0.3f, 0.2f), 0.2f);
}

} // namespace tessera
