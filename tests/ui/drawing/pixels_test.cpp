// Single pixels: values under the mouse, numbers, magnifier, tone, ranges, marks.

#include "tests/ui/drawing/panes_fixture.h"
#include "ui/panes/pane_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

namespace tessera::test {
namespace {

struct Pixels : Panes {
    const PaneImages& images() { return viewer.pictures().images(); }
};

TEST_F(Pixels, ValuesUnderTheMouseInAllPanes) {
    EXPECT_EQ(cursor_text(state(), images(), 0), "");
    for (const glm::ivec2 pixel : {glm::ivec2(0, 0), glm::ivec2(20, 7), glm::ivec2(47, 35)}) {
        move_to(middle_of(0, pixel.x, pixel.y));
        for (int i = 0; i < 2; ++i) {
            const Rgb value = viewer.pictures().image(i).pixels()(pixel.x, pixel.y);
            char expected[160];
            std::snprintf(expected, sizeof expected, "(%d, %d)  %.4g %.4g %.4g  Y %.4g", pixel.x, pixel.y,
                          static_cast<double>(value.r), static_cast<double>(value.g), static_cast<double>(value.b),
                          static_cast<double>(luminance(value)));
            EXPECT_EQ(cursor_text(state(), images(), i), expected);
            EXPECT_TRUE(has("pane" + std::to_string(i) + ".value"));
        }
    }
    save("cursor-values.png");
    choose("pane1.buffer", "survival");
    move_to(middle_of(0, 20, 20));
    EXPECT_NE(cursor_text(state(), images(), 1).find(" %"), std::string::npos);
    move_to({5, 5}); // over the menu bar
    EXPECT_EQ(cursor_text(state(), images(), 0), "");
    EXPECT_FALSE(has("pane0.value"));
}

TEST_F(Pixels, ValuesOfADifferenceAreDifferences) {
    click("pane0.picture");
    type(Key::n);
    move_to(middle_of(0, 20, 20));
    const auto value = value_at(showing_at(state(), 0, 0.5f), images(), state().layout.cursor->place);
    ASSERT_TRUE(value);
    const Rgb expected = viewer.pictures().image(0).pixels()(20, 20) - viewer.pictures().image(1).pixels()(20, 20);
    EXPECT_EQ(*value, expected);
}

TEST_F(Pixels, LargePixelsShowTheirValues) {
    move_to(middle_of(0, 20, 20));
    modifiers(true, false);
    const auto white = [&] { // counts white pixels of digits
        const ScreenPixels pixels = screen();
        const ControlRect rect = place("pane0.picture");
        int count = 0;
        for (float y = rect.min.y; y < rect.max.y; ++y)
            for (float x = rect.min.x; x < rect.max.x; ++x)
                count += glm::all(glm::greaterThan(colour(pixels, {x, y}), glm::vec3(225)));
        return count;
    };
    while (state().display.view.zoom() < 10)
        wheel(1);
    modifiers(false, false);
    save("numbers.png");
    EXPECT_GT(white(), 200);
    choose("pane0.buffer", "dx"); // PT has no gradients, so there are no values
    frames(2);
    EXPECT_EQ(white(), 0);
}

TEST(PixelNumbers, FitIntoSevenCharacters) {
    EXPECT_EQ(short_number(0.01234f), "0.0123");
    EXPECT_EQ(short_number(-0.01234f), "-0.0123");
    EXPECT_EQ(short_number(-1.234e-5f), "-1e-05");
    EXPECT_EQ(short_number(1.234e-5f), "1.2e-05");
    EXPECT_EQ(short_number(-1.234e12f), "-1e+12");
    EXPECT_EQ(short_number(-std::numeric_limits<float>::infinity()), "-inf");
}

// A preview has a quarter of the size, but pixel coordinates are those of the full picture.
TEST_F(Pixels, APreviewHasThePixelCoordinatesOfTheFullPicture) {
    auto coarse = std::make_shared<Snapshot>(*pane(1).snapshot);
    coarse->divisor = 4;
    coarse->reconstruction = nullptr;
    auto images = std::make_shared<GradientImages>();
    images->primal = RgbImage(12, 9, Rgb(0.5f));
    coarse->images = images;
    PaneImages looks;
    looks[1].take(coarse.get(), Buffer::primal, {});
    state().layout.cursor = Cursor{1, {0.5f, 0.5f}, 0.5f};
    EXPECT_EQ(cursor_text(state(), looks, 1).substr(0, 8), "(24, 18)");
}

TEST_F(Pixels, MagnifierEnlargesAroundTheMouse) {
    type(Key::l);
    EXPECT_TRUE(state().display.magnifier);
    const glm::vec2 at = middle_of(0, 12, 18);
    move_to(at);
    save("magnifier.png");
    const ScreenPixels pixels = screen();
    type(Key::l);
    move_to(at);
    const ScreenPixels plain = screen();
    // Image pixels are at least 15 units wide in the magnifier, and the pixel under the mouse does not move.
    EXPECT_LT(glm::distance(colour(pixels, at), colour(plain, at)), 2);
    EXPECT_LT(glm::distance(colour(pixels, at + glm::vec2(5, 5)), colour(pixels, at)), 2);
    EXPECT_NE(pixels.rgb, plain.rgb);
    // The other pane has a magnifier, too.
    const glm::vec2 other = middle_of(1, 12, 18);
    EXPECT_LT(glm::distance(colour(pixels, other + glm::vec2(4, 4)), colour(pixels, other)), 2);
}

TEST_F(Pixels, LegendsAreDraggedAndReset) {
    choose("pane1.buffer", "reused");
    const ControlRect legend = place("pane1.legend");
    const ValueRange before = viewer.pictures().image(1).range();
    const auto camera = state().camera.position();
    const glm::vec2 bar(0, legend.max.y - 11);
    drag({legend.max.x - 20, bar.y}, {-30, 0});
    ASSERT_TRUE(state().display.ranges.count(Buffer::reused));
    const ValueRange high = state().display.ranges.at(Buffer::reused);
    EXPECT_LT(high.high, before.high);
    EXPECT_EQ(high.low, 0);
    EXPECT_EQ(state().camera.position(), camera);
    drag({legend.min.x + 20, bar.y}, {30, 0});
    EXPECT_GT(state().display.ranges.at(Buffer::reused).low, 0);
    save("legend-range.png");
    frame(1); // prevents a double click with the last click
    click(glm::vec2(legend.min.x + 20, bar.y));
    click(glm::vec2(legend.min.x + 20, bar.y));
    EXPECT_EQ(state().display.ranges.count(Buffer::reused), 0u);
}

TEST_F(Pixels, ToneCurves) {
    choose("tone", "filmic");
    EXPECT_EQ(state().display.tone.curve, Tone::Curve::filmic);
    type(Key::y);
    EXPECT_EQ(state().display.tone.curve, Tone::Curve::srgb);
    const double before = brightness("pane0.picture");
    type(Key::y);
    EXPECT_EQ(state().display.tone.curve, Tone::Curve::filmic);
    frames(2);
    EXPECT_NE(brightness("pane0.picture"), before);
}

TEST(ValueRange, FractionsAndValuesAreInverse) {
    for (const ValueRange& range :
         {ValueRange{0, 5, false}, ValueRange{2, 3, false}, ValueRange{1e-4f, 10, true}}) {
        for (float share : {0.0f, 0.25f, 1.0f})
            EXPECT_NEAR(range.share(range.value(share)), share, 1e-5f);
        ValueRange dragged = range;
        for (int i = 0; i < 50; ++i)
            dragged = dragged.with_low_dragged(0.9f).with_high_dragged(-0.9f);
        EXPECT_GT(dragged.high, dragged.low);
        EXPECT_GT(dragged.high, 0);
    }
    EXPECT_FLOAT_EQ((ValueRange{1e-4f, 10, true}.value(0.2f)), 1e-3f);
    EXPECT_LT((ValueRange{1e-4f, 10, true}.share(0)), 0);
}

} // namespace
} // namespace tessera::test
