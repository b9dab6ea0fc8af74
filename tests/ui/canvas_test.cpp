#include "tests/ui/osmesa_context.h"
#include "ui/canvas.h"
#include "ui/false_colours.h"
#include "ui/screenshot.h"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace tessera {
namespace {

using Colour = std::array<int, 3>;

int srgb(float c) {
    c = std::min(std::max(c, 0.0f), 1.0f);
    const float encoded = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
    return static_cast<int>(std::lround(encoded * 255));
}

class CanvasTest : public testing::Test {
protected:
    test::OsmesaContext context_{{16, 16}};
    CanvasShader shader_;
    Canvas canvas_;

    /// The image over the whole of a pane.
    CanvasView filling(glm::ivec2 pane_size) const { return {pane_size, {0, 0}, glm::vec2(pane_size)}; }

    Colour pixel(int x, int y) const {
        glBindFramebuffer(GL_FRAMEBUFFER, canvas_.framebuffer().name());
        const ScreenPixels pixels = read_screen(canvas_.framebuffer().size());
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        const std::uint8_t* p = pixels.at(x, y);
        return {p[0], p[1], p[2]};
    }
    void expect_colour(int x, int y, Colour expected, int tolerance = 1) const {
        const Colour seen = pixel(x, y);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(seen[i], expected[i], tolerance) << "channel " << i << " of " << x << ',' << y;
    }
};

const Colour magenta{255, 0, 255}, cyan{0, 255, 255};
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

TEST_F(CanvasTest, RadianceIsExposedAndEncodedAsSrgb) {
    RgbImage image(2, 1);
    image(0, 0) = {0.18f, 0.5f, 0.002f};
    image(1, 0) = {4, -1, 0};
    canvas_.show(image);
    CanvasView view = filling({8, 4});
    for (float stops : {0.0f, 1.0f, -3.0f}) {
        view.exposure = stops;
        canvas_.draw(shader_, view);
        const float gain = std::exp2(stops);
        expect_colour(1, 1, {srgb(0.18f * gain), srgb(0.5f * gain), srgb(0.002f * gain)});
        expect_colour(6, 1, {srgb(4 * gain), 0, 0});
    }
}

TEST_F(CanvasTest, ImageStandsUprightAndUnmirrored) {
    RgbImage image(2, 2);
    image(0, 0) = {1, 0, 0};
    image(1, 0) = {0, 1, 0};
    image(0, 1) = {0, 0, 1};
    canvas_.show(image);
    canvas_.draw(shader_, filling({10, 10}));
    expect_colour(0, 0, {255, 0, 0});
    expect_colour(4, 4, {255, 0, 0});
    expect_colour(5, 4, {0, 255, 0});
    expect_colour(4, 5, {0, 0, 255});
    expect_colour(9, 9, {0, 0, 0});
}

TEST_F(CanvasTest, GradientsShowTheirSignByHue) {
    RgbImage image(3, 1);
    image(0, 0) = Rgb(0.25f);
    image(1, 0) = Rgb(0);
    image(2, 0) = Rgb(-0.25f);
    canvas_.show(image);
    CanvasView view = filling({9, 3});
    view.colour_map = ColourMap::signed_difference;
    view.exposure = 2; // now at full strength
    canvas_.draw(shader_, view);
    expect_colour(1, 1, {255, 168, 51});
    expect_colour(4, 1, {26, 26, 28});
    expect_colour(7, 1, {66, 158, 255});

    view.exposure = 0;
    canvas_.draw(shader_, view);
    const Colour plus = pixel(1, 1), minus = pixel(7, 1);
    EXPECT_GT(plus[0], plus[2] + 30);
    EXPECT_GT(minus[2], minus[0] + 30);
    EXPECT_LT(plus[0], 200);
}

Colour display(glm::vec3 c) {
    return {static_cast<int>(std::lround(c.r * 255)), static_cast<int>(std::lround(c.g * 255)),
            static_cast<int>(std::lround(c.b * 255))};
}

TEST_F(CanvasTest, FalseColoursReachFromZeroToTheTop) {
    RgbImage image(5, 1, Rgb(0));
    image(1, 0) = Rgb(3);
    image(2, 0) = Rgb(6);
    image(3, 0) = Rgb(60);
    image(4, 0) = Rgb(1.875f); // half-way between the third colour and the fourth
    canvas_.show(image);
    CanvasView view = filling({15, 3});
    view.colour_map = ColourMap::false_colour;
    view.top = 6;
    for (float stops : {0.0f, 3.0f}) { // exposure is for light
        view.exposure = stops;
        canvas_.draw(shader_, view);
        expect_colour(1, 1, display(false_colours.front()));
        expect_colour(4, 1, display(false_colours[4]));
        expect_colour(7, 1, display(false_colours.back()));
        expect_colour(10, 1, display(false_colours.back()));
        expect_colour(13, 1, display((false_colours[2] + false_colours[3]) * 0.5f));
    }
}

TEST(FalseColours, GreaterIsBrighter) {
    const auto linear = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
    float before = -1;
    for (const glm::vec3& c : false_colours) {
        const float lightness = std::cbrt(luminance({linear(c.r), linear(c.g), linear(c.b)}));
        EXPECT_GT(lightness, before + 0.05f);
        before = lightness;
    }
}

TEST_F(CanvasTest, NanAndInfinityAreMarkedInEveryView) {
    RgbImage image(3, 1);
    image(0, 0) = {0, nan, 0};
    image(1, 0) = {infinity, 0, 0};
    image(2, 0) = {0, 0, -infinity};
    canvas_.show(image);
    CanvasView view = filling({9, 3});
    for (ColourMap map : {ColourMap::radiance, ColourMap::signed_difference, ColourMap::false_colour}) {
        view.colour_map = map;
        canvas_.draw(shader_, view);
        expect_colour(1, 1, magenta, 0);
        expect_colour(4, 1, cyan, 0);
        expect_colour(7, 1, cyan, 0);
    }
    view.coarse = true;
    canvas_.draw(shader_, view);
    expect_colour(0, 1, magenta, 0);
}

TEST_F(CanvasTest, ShrinkingAveragesAndLosesNoNan) {
    RgbImage image(8, 8, Rgb(0.5f));
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 4; ++x)
            image(x, y) = Rgb((x + y) % 2 ? 1.0f : 0.0f);
    }
    image(6, 1) = Rgb(1000); // one bright pixel counts as white, no more
    image(6, 6) = Rgb(nan);
    canvas_.show(image);
    canvas_.draw(shader_, filling({2, 2}));
    expect_colour(0, 0, {srgb(0.5f), srgb(0.5f), srgb(0.5f)});
    const int brighter = srgb((15 * 0.5f + 1) / 16);
    expect_colour(1, 0, {brighter, brighter, brighter});
    expect_colour(1, 1, magenta, 0);
}

TEST_F(CanvasTest, EnlargedPixelsAreSquaresUnlessCoarse) {
    RgbImage image(2, 1);
    image(1, 0) = Rgb(1);
    canvas_.show(image);
    CanvasView view = filling({20, 4});
    canvas_.draw(shader_, view);
    expect_colour(9, 2, {0, 0, 0});
    expect_colour(10, 2, {255, 255, 255});
    view.coarse = true;
    canvas_.draw(shader_, view);
    const Colour left = pixel(9, 2), right = pixel(10, 2);
    EXPECT_GT(left[0], srgb(0.3f));
    EXPECT_LT(right[0], srgb(0.7f));
}

TEST_F(CanvasTest, BackgroundSurroundsTheImage) {
    canvas_.show(RgbImage(2, 2, Rgb(1)));
    canvas_.draw(shader_, {{20, 10}, {5, 3}, {4, 4}});
    const Colour background = pixel(0, 0);
    EXPECT_LT(background[0], 30);
    EXPECT_EQ(pixel(4, 3), background);
    expect_colour(5, 3, {255, 255, 255});
    expect_colour(8, 6, {255, 255, 255});
    EXPECT_EQ(pixel(9, 6), background);
    EXPECT_EQ(pixel(8, 7), background);
}

TEST_F(CanvasTest, DrawsAgainOnlyWhenSomethingChanged) {
    canvas_.show(RgbImage(2, 2, Rgb(1)));
    CanvasView view = filling({8, 8});
    canvas_.draw(shader_, view);
    canvas_.draw(shader_, view);
    EXPECT_EQ(canvas_.drawings(), 1);
    view.exposure = -1;
    canvas_.draw(shader_, view);
    EXPECT_EQ(canvas_.drawings(), 2);
    canvas_.show(RgbImage(2, 2, Rgb(0.5f)));
    canvas_.draw(shader_, view);
    EXPECT_EQ(canvas_.drawings(), 3);
}

TEST_F(CanvasTest, EmptyImagesAndPanesAreHarmless) {
    EXPECT_EQ(canvas_.draw(shader_, filling({0, 10})), 0u);
    EXPECT_NE(canvas_.draw(shader_, filling({1, 1})), 0u);
    canvas_.show(RgbImage(3, 3, Rgb(1)));
    canvas_.draw(shader_, filling({4, 4}));
    expect_colour(2, 2, {255, 255, 255});
    canvas_.show(RgbImage());
    canvas_.draw(shader_, filling({4, 4}));
    EXPECT_LT(pixel(2, 2)[0], 30);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(CanvasTest, ImagesOfChangingSizeReplaceEachOther) {
    for (int size : {5, 1, 64, 3}) {
        canvas_.show(RgbImage(size, size, Rgb(0.2f)));
        canvas_.draw(shader_, filling({size, size}));
        expect_colour(size - 1, size - 1, {srgb(0.2f), srgb(0.2f), srgb(0.2f)});
    }
}

TEST_F(CanvasTest, LeavesTheBoundFramebufferAlone) {
    Framebuffer other;
    other.resize({4, 4});
    const DrawInto outer(other);
    canvas_.show(RgbImage(1, 1, Rgb(1)));
    canvas_.draw(shader_, filling({16, 16}));
    GLint bound = 0, viewport[4] = {};
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    glGetIntegerv(GL_VIEWPORT, viewport);
    EXPECT_EQ(static_cast<GLuint>(bound), other.name());
    EXPECT_EQ(viewport[2], 4);
}

} // namespace
} // namespace tessera
