#include "tests/ui/drawing/canvas_fixture.h"

#include <cmath>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

/// Whether any program of the context uses the uniform.
bool is_used(const char* uniform) {
    constexpr GLuint names = 64; // enough for a fresh context
    for (GLuint name = 1; name < names; ++name)
        if (glIsProgram(name) != GL_FALSE && glGetUniformLocation(name, uniform) >= 0)
            return true;
    return false;
}

TEST_F(CanvasTest, RadianceIsExposedAndEncodedAsSrgb) {
    RgbImage image(2, 1);
    image(0, 0) = {0.18f, 0.5f, 0.002f};
    image(1, 0) = {4, -1, 0};
    image_.show(image);
    CanvasView view = filling({8, 4});
    for (float stops : {0.0f, 1.0f, -3.0f}) {
        view.tone.exposure = stops;
        canvas_.draw(shader_, image_, view);
        const float gain = std::exp2(stops);
        expect_colour(1, 1, {srgb(0.18f * gain), srgb(0.5f * gain), srgb(0.002f * gain)});
        expect_colour(6, 1, {srgb(4 * gain), 0, 0});
    }
}

TEST_F(CanvasTest, ImageIsUprightAndNotMirrored) {
    RgbImage image(2, 2);
    image(0, 0) = {1, 0, 0};
    image(1, 0) = {0, 1, 0};
    image(0, 1) = {0, 0, 1};
    image_.show(image);
    canvas_.draw(shader_, image_, filling({10, 10}));
    expect_colour(0, 0, {255, 0, 0});
    expect_colour(4, 4, {255, 0, 0});
    expect_colour(5, 4, {0, 255, 0});
    expect_colour(4, 5, {0, 0, 255});
    expect_colour(9, 9, {0, 0, 0});
}

TEST_F(CanvasTest, NanAndInfinityAreMarkedInEveryView) {
    RgbImage image(3, 1);
    image(0, 0) = {0, nan, 0};
    image(1, 0) = {infinity, 0, 0};
    image(2, 0) = {0, 0, -infinity};
    image_.show(image);
    CanvasView view = filling({9, 3});
    for (ColourMap map : {ColourMap::radiance, ColourMap::signed_difference, ColourMap::false_colour}) {
        view.colour_map = map;
        canvas_.draw(shader_, image_, view);
        expect_colour(1, 1, magenta, 0);
        expect_colour(4, 1, cyan, 0);
        expect_colour(7, 1, cyan, 0);
    }
    view.coarse = true;
    canvas_.draw(shader_, image_, view);
    expect_colour(0, 1, magenta, 0);
}

TEST_F(CanvasTest, ShrinkingAveragesAndKeepsNanMarks) {
    RgbImage image(8, 8, Rgb(0.5f));
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 4; ++x)
            image(x, y) = Rgb((x + y) % 2 ? 1.0f : 0.0f);
    }
    image(6, 1) = Rgb(1000); // a bright pixel counts as white at most
    image(6, 6) = Rgb(nan);
    image_.show(image);
    canvas_.draw(shader_, image_, filling({2, 2}));
    expect_colour(0, 0, {srgb(0.5f), srgb(0.5f), srgb(0.5f)});
    const int brighter = srgb((15 * 0.5f + 1) / 16);
    expect_colour(1, 0, {brighter, brighter, brighter});
    expect_colour(1, 1, magenta, 0);
}

TEST_F(CanvasTest, StrongShrinkingKeepsMarks) {
    for (int place = 0; place < 60; place += 7) {
        RgbImage image(120, 60, Rgb(0.5f));
        image(place, 59 - place) = Rgb(nan);
        image(60 + place, place) = {0, -infinity, 0};
        image_.show(image);
        canvas_.draw(shader_, image_, filling({2, 1})); // 60 pixels become one
        expect_colour(0, 0, magenta, 0);
        expect_colour(1, 0, cyan, 0);
    }
}

TEST_F(CanvasTest, ADifferenceToAnEmptyImageIsEmpty) {
    ImageTexture nothing;
    image_.show(RgbImage(4, 4, Rgb(1)));
    CanvasView view = filling({4, 4});
    view.colour_map = ColourMap::signed_difference;
    canvas_.draw(shader_, image_, view, &nothing);
    EXPECT_LT(pixel(2, 2)[0], 30);
    nothing.show(RgbImage(4, 4, Rgb(0.25f)));
    canvas_.draw(shader_, image_, view, &nothing);
    EXPECT_GT(pixel(2, 2)[0], 100);
}

TEST_F(CanvasTest, EnlargedPixelsAreSquaresExceptInPreviews) {
    RgbImage image(2, 1);
    image(1, 0) = Rgb(1);
    image_.show(image);
    CanvasView view = filling({20, 4});
    canvas_.draw(shader_, image_, view);
    expect_colour(9, 2, {0, 0, 0});
    expect_colour(10, 2, {255, 255, 255});
    view.coarse = true;
    canvas_.draw(shader_, image_, view);
    const Colour left = pixel(9, 2), right = pixel(10, 2);
    EXPECT_NEAR(left[0], 255 * 0.45, 2); // halfway between their centres, in steps of a tenth
    EXPECT_NEAR(right[0], 255 * 0.55, 2);
}

TEST_F(CanvasTest, BackgroundSurroundsTheImage) {
    image_.show(RgbImage(2, 2, Rgb(1)));
    canvas_.draw(shader_, image_, {{20, 10}, {5, 3}, {4, 4}});
    const Colour background = pixel(0, 0);
    EXPECT_LT(background[0], 30);
    EXPECT_EQ(pixel(4, 3), background);
    expect_colour(5, 3, {255, 255, 255});
    expect_colour(8, 6, {255, 255, 255});
    EXPECT_EQ(pixel(9, 6), background);
    EXPECT_EQ(pixel(8, 7), background);
}

TEST_F(CanvasTest, APreviewCoversTheSameArea) {
    RgbImage image(3, 2, Rgb(1));
    image(2, 1) = Rgb(0.5f);
    image_.show(image);
    for (const glm::vec2 origin :
         {glm::vec2(5, 3), glm::vec2(-4, -2), glm::vec2(14, 6)}) { // also beyond the borders
        CanvasView view{{20, 10}, origin, {9, 6}};
        const ScreenPixels sharp = drawn(view);
        view.coarse = true;
        const ScreenPixels coarse = drawn(view);
        for (std::size_t i = 0; i < sharp.rgb.size(); ++i)
            EXPECT_NEAR(sharp.rgb[i], coarse.rgb[i], 70) << i; // interpolates 255 and 188, but not the background
    }
}

TEST_F(CanvasTest, RedrawsOnlyAfterChanges) {
    image_.show(RgbImage(2, 2, Rgb(1)));
    CanvasView view = filling({8, 8});
    canvas_.draw(shader_, image_, view);
    canvas_.draw(shader_, image_, view);
    EXPECT_EQ(canvas_.drawings(), 1);
    view.tone.exposure = -1;
    canvas_.draw(shader_, image_, view);
    EXPECT_EQ(canvas_.drawings(), 2);
    image_.show(RgbImage(2, 2, Rgb(0.5f)));
    canvas_.draw(shader_, image_, view);
    EXPECT_EQ(canvas_.drawings(), 3);
}

// Software renderers execute all code of a program at every pixel.
TEST_F(CanvasTest, ProgramsContainOnlyWhatTheirViewsNeed) {
    image_.show(RgbImage(2, 2, Rgb(1)));
    CanvasView view = filling({8, 8});
    canvas_.draw(shader_, image_, view);
    EXPECT_TRUE(is_used("gain"));
    EXPECT_FALSE(is_used("false_colours"));
    EXPECT_FALSE(is_used("subtrahend"));
    view.colour_map = ColourMap::false_colour;
    canvas_.draw(shader_, image_, view);
    EXPECT_TRUE(is_used("false_colours"));
    canvas_.draw(shader_, image_, view, &image_);
    EXPECT_TRUE(is_used("subtrahend"));
}

TEST_F(CanvasTest, EmptyImagesAndPanesAreHarmless) {
    EXPECT_EQ(canvas_.draw(shader_, image_, filling({0, 10})), 0u);
    EXPECT_NE(canvas_.draw(shader_, image_, filling({1, 1})), 0u);
    image_.show(RgbImage(3, 3, Rgb(1)));
    canvas_.draw(shader_, image_, filling({4, 4}));
    expect_colour(2, 2, {255, 255, 255});
    image_.show(RgbImage());
    canvas_.draw(shader_, image_, filling({4, 4}));
    EXPECT_LT(pixel(2, 2)[0], 30);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(CanvasTest, ImagesOfDifferentSizesReplaceEachOther) {
    for (int size : {5, 1, 64, 3}) {
        image_.show(RgbImage(size, size, Rgb(0.2f)));
        canvas_.draw(shader_, image_, filling({size, size}));
        expect_colour(size - 1, size - 1, {srgb(0.2f), srgb(0.2f), srgb(0.2f)});
    }
}

/// Red on the left, green on the right.
RgbImage two_halves(int width, int height) {
    RgbImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image(x, y) = 2 * x < width ? Rgb(1, 0, 0) : Rgb(0, 1, 0);
    return image;
}

TEST_F(CanvasTest, ImagesLargerThanTexturesAreReduced) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    image_.show(two_halves(most + 10, 2));
    drawn(filling({60, 20}));
    expect_colour(10, 10, {255, 0, 0});
    expect_colour(50, 10, {0, 255, 0});
    EXPECT_LE(image_.texture().size().x, most);
}

TEST_F(CanvasTest, AReducedPixelIsTheMeanOfItsPixels) {
    RgbImage image = two_halves(40, 30);
    image(39, 29) = Rgb(nan);
    image_.show(image, 16);
    EXPECT_EQ(image_.texture().size(), glm::ivec2(14, 10));
    drawn(filling({140, 100}));
    expect_colour(5, 5, {255, 0, 0});
    expect_colour(65, 50, {srgb(2 / 3.0f), srgb(1 / 3.0f), 0}); // columns 18, 19 and 20
    expect_colour(135, 5, {0, 255, 0});
    expect_colour(135, 95, magenta); // the last, odd pixel is kept
    image_.show(two_halves(40, 30), 40);
    EXPECT_EQ(image_.texture().size(), glm::ivec2(40, 30));
}

TEST_F(CanvasTest, LeavesTheBoundFramebufferAlone) {
    Framebuffer other;
    other.resize({4, 4});
    const DrawInto outer(other);
    image_.show(RgbImage(1, 1, Rgb(1)));
    canvas_.draw(shader_, image_, filling({16, 16}));
    GLint bound = 0, viewport[4] = {};
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    glGetIntegerv(GL_VIEWPORT, viewport);
    EXPECT_EQ(static_cast<GLuint>(bound), other.name());
    EXPECT_EQ(viewport[2], 4);
}

} // namespace
} // namespace tessera
