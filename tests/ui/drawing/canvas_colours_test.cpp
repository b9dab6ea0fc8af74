// Colours of values on a canvas.

#include "tests/ui/drawing/canvas_fixture.h"
#include "ui/gl/tone.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tessera {
namespace {

Colour display(glm::vec3 c) {
    return {static_cast<int>(std::lround(c.r * 255)), static_cast<int>(std::lround(c.g * 255)),
            static_cast<int>(std::lround(c.b * 255))};
}

TEST_F(CanvasTest, HueShowsTheSignOfGradients) {
    RgbImage image(3, 1);
    image(0, 0) = Rgb(0.25f);
    image(1, 0) = Rgb(0);
    image(2, 0) = Rgb(-0.25f);
    image_.show(image);
    CanvasView view = filling({9, 3});
    view.colour_map = ColourMap::signed_difference;
    view.tone.exposure = 2; // at full strength
    canvas_.draw(shader_, image_, view);
    expect_colour(1, 1, {255, 168, 51});
    expect_colour(4, 1, {26, 26, 28});
    expect_colour(7, 1, {66, 158, 255});

    view.tone.exposure = 0;
    canvas_.draw(shader_, image_, view);
    const Colour plus = pixel(1, 1), minus = pixel(7, 1);
    EXPECT_GT(plus[0], plus[2] + 30);
    EXPECT_GT(minus[2], minus[0] + 30);
    EXPECT_LT(plus[0], 200);
}

TEST_F(CanvasTest, FalseColoursSpanTheirRange) {
    RgbImage image(5, 1, Rgb(0));
    image(1, 0) = Rgb(3);
    image(2, 0) = Rgb(6);
    image(3, 0) = Rgb(60);
    image(4, 0) = Rgb(1.875f); // half-way between the third colour and the fourth
    image_.show(image);
    CanvasView view = filling({15, 3});
    view.colour_map = ColourMap::false_colour;
    view.range.high = 6;
    for (float stops : {0.0f, 3.0f}) { // exposure applies to radiance only
        view.tone.exposure = stops;
        canvas_.draw(shader_, image_, view);
        expect_colour(1, 1, display(false_colours.front()));
        expect_colour(4, 1, display(false_colours[4]));
        expect_colour(7, 1, display(false_colours.back()));
        expect_colour(10, 1, display(false_colours.back()));
        expect_colour(13, 1, display((false_colours[2] + false_colours[3]) * 0.5f));
    }
}

TEST_F(CanvasTest, NegativeRadianceIsMarkedOnRequest) {
    RgbImage image(2, 1, Rgb(0.5f));
    image(0, 0) = {0.5f, -0.01f, 0.5f};
    image_.show(image);
    CanvasView view = filling({6, 3});
    canvas_.draw(shader_, image_, view);
    expect_colour(1, 1, {srgb(0.5f), 0, srgb(0.5f)});
    view.mark_negative = true;
    canvas_.draw(shader_, image_, view);
    expect_colour(1, 1, {38, 64, 255});
    expect_colour(4, 1, {srgb(0.5f), srgb(0.5f), srgb(0.5f)});
    view.colour_map = ColourMap::signed_difference; // negative values are valid there
    canvas_.draw(shader_, image_, view);
    EXPECT_NE(pixel(1, 1), (Colour{38, 64, 255}));
}

TEST_F(CanvasTest, ToneCurves) {
    image_.show(RgbImage(1, 1, Rgb(0.4f, 1.5f, 40)));
    CanvasView view = filling({3, 3});
    view.tone = {Tone::Curve::srgb, -1};
    canvas_.draw(shader_, image_, view);
    expect_colour(1, 1, {srgb(0.2f), srgb(0.75f), 255});
    view.tone = {Tone::Curve::filmic, 0};
    canvas_.draw(shader_, image_, view);
    const auto filmic = [](float x) { return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f); };
    expect_colour(1, 1, {srgb(filmic(0.4f)), srgb(filmic(1.5f)), 255}, 2);
    EXPECT_LT(pixel(1, 1)[1], 255); // values above 1 are not clipped to white
}

TEST_F(CanvasTest, DisplayColoursStayUnchanged) {
    RgbImage image(2, 1, Rgb(0.25f, 0.5f, 1));
    image(1, 0) = Rgb(2, nan, 0);
    image_.show(image);
    CanvasView view = filling({6, 3});
    view.colour_map = ColourMap::own;
    view.mark_negative = true;
    for (float stops : {0.0f, 3.0f}) { // exposure and tone do not apply to display colours
        view.tone = {Tone::Curve::filmic, stops};
        canvas_.draw(shader_, image_, view);
        expect_colour(1, 1, {64, 128, 255});
        expect_colour(4, 1, magenta);
    }
}

TEST_F(CanvasTest, LogarithmicFalseColours) {
    RgbImage image(4, 1, Rgb(0));
    image(1, 0) = Rgb(1e-4f);
    image(2, 0) = Rgb(1e-2f); // half-way
    image(3, 0) = Rgb(5);
    image_.show(image);
    CanvasView view = filling({12, 3});
    view.colour_map = ColourMap::false_colour;
    view.range = {1e-4f, 1, true};
    canvas_.draw(shader_, image_, view);
    expect_colour(1, 1, display(false_colours.front()));
    expect_colour(4, 1, display(false_colours.front()));
    expect_colour(7, 1, display(false_colours[4]));
    expect_colour(10, 1, display(false_colours.back()));
}

TEST_F(CanvasTest, DifferencesOfTwoImages) {
    RgbImage image(2, 1, Rgb(0.75f));
    image(1, 0) = Rgb(0.25f);
    image_.show(image);
    ImageTexture other;
    other.show(RgbImage(1, 1, Rgb(0.5f))); // another size, which is stretched
    CanvasView view = filling({6, 3});
    view.colour_map = ColourMap::signed_difference;
    view.tone.exposure = 2;
    canvas_.draw(shader_, image_, view, &other);
    expect_colour(1, 1, {255, 168, 51});
    expect_colour(4, 1, {66, 158, 255});
    canvas_.draw(shader_, image_, view);
    expect_colour(4, 1, {255, 168, 51});
    other.show(image);
    canvas_.draw(shader_, image_, view, &other); // a new image is redrawn
    expect_colour(4, 1, {26, 26, 28});
}

TEST(FalseColours, LargerValuesAreBrighter) {
    const auto linear = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
    float before = -1;
    for (const glm::vec3& c : false_colours) {
        const float lightness = std::cbrt(luminance({linear(c.r), linear(c.g), linear(c.b)}));
        EXPECT_GT(lightness, before + 0.05f);
        before = lightness;
    }
}

} // namespace
} // namespace tessera
