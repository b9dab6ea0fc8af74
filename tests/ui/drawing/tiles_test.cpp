// The overlay of tiles: it shows the tiles of the newest pass, and does not change images.

#include "render/estimator/tile_grid.h"
#include "tests/ui/viewer_harness.h"

#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

struct Tiles : testing::Test, ViewerHarness {
    Tiles() { rest(3); }

    glm::vec2 corner(int index, glm::ivec2 pixel) const {
        const ControlRect rect = place("pane" + std::to_string(index) + ".picture");
        const auto& p = const_cast<Tiles*>(this)->pane(index);
        const Placement placement = const_cast<Tiles*>(this)->state().display.view.place({48, 36}, p.canvas_size);
        return rect.min + placement.origin + glm::vec2(pixel) / glm::vec2(48, 36) * placement.extent;
    }
    glm::vec3 colour(const ScreenPixels& pixels, glm::vec2 at) const {
        const std::uint8_t* p = pixels.at(static_cast<int>(at.x), static_cast<int>(at.y));
        return {p[0], p[1], p[2]};
    }
    int changed(const ScreenPixels& a, const ScreenPixels& b, glm::vec2 from, glm::vec2 to) const {
        int count = 0;
        for (int y = static_cast<int>(from.y); y < static_cast<int>(to.y); ++y)
            for (int x = static_cast<int>(from.x); x < static_cast<int>(to.x); ++x)
                count += colour(a, {x, y}) != colour(b, {x, y});
        return count;
    }
};

TEST_F(Tiles, ShowsTheTilesOfTheNewestPass) {
    const ScreenPixels before = screen();
    const RgbImage image = viewer.pictures().image(1).pixels();
    type(Key::x);
    EXPECT_TRUE(state().display.show_tiles);
    save("tiles.png");
    const ScreenPixels after = screen();
    const Snapshot& snapshot = *pane(1).snapshot;
    ASSERT_TRUE(snapshot.learned);
    const TileGrid grid({48, 36}, snapshot.settings, *snapshot.learned, snapshot.spp - 1);
    // Pixels change on the lines, but not in the middle of pixels without a line.
    const PixelRect tile = grid.tile_at({20, 16});
    const glm::vec2 a = corner(1, {tile.x0, tile.y0}), b = corner(1, {tile.x0 + 1, tile.y0 + 1});
    EXPECT_GT(changed(before, after, {a.x - 1, a.y + 2}, {a.x + 2, b.y - 2}), 0);
    EXPECT_GT(changed(before, after, {a.x + 3, a.y - 1}, {b.x - 3, a.y + 2}), 0);
    EXPECT_EQ(changed(before, after, a + 4.0f, b - 4.0f), 0);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            EXPECT_EQ(viewer.pictures().image(1).pixels()(x, y), image(x, y));
    type(Key::x);
    EXPECT_EQ(screen().rgb, before.rgb);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(Tiles, MarksTheSetOfThePixelUnderTheMouse) {
    type(Key::x);
    const Snapshot& snapshot = *pane(1).snapshot;
    const TileGrid grid({48, 36}, snapshot.settings, *snapshot.learned, snapshot.spp - 1);
    const PixelRect split = grid.split_at({20, 16});
    const ScreenPixels before = screen();
    move_to((corner(1, {20, 16}) + corner(1, {21, 17})) * 0.5f);
    const ScreenPixels after = screen();
    save("tiles-set.png");
    const auto middle = [&](int x, int y) { return (corner(1, {x, y}) + corner(1, {x + 1, y + 1})) * 0.5f; };
    // The pixels of the set become greener, its border more orange, and others stay.
    const glm::vec3 inner = colour(after, middle(split.x0, split.y0)) - colour(before, middle(split.x0, split.y0));
    const glm::vec3 border =
        colour(after, middle(split.x1, split.y0)) - colour(before, middle(split.x1, split.y0));
    EXPECT_GT(inner.g - inner.r, 10);
    EXPECT_GT(border.r - border.b, 10);
    const glm::vec2 outside = middle(split.x1 + 2, split.y0);
    EXPECT_EQ(colour(after, outside), colour(before, outside));
}

/// Pixels of one sampling set have the same colour, and other sets have other colours.
TEST_F(Tiles, EachRooksPatternHasOneColour) {
    state().panes[1].settings.render.method = Method::pr;
    state().panes[1].settings.render.pattern = Pattern::rooks;
    state().panes[1].settings.render.tile = 3;
    state().panes[1].settings.buffer = Buffer::survival;      // false colours
    state().display.ranges[Buffer::survival] = {2, 3, false}; // a range that gives all pixels the lowest colour
    state().set_view(ImageView(4, {0.5f, 0.5f}));
    frames(2);
    wait_until([&] { return viewer.settled(3); });
    type(Key::x);
    frames(2);
    save("tiles-rooks-colours.png");
    const ScreenPixels shown = screen();
    const Snapshot& snapshot = *pane(1).snapshot;
    TileGrid grid({48, 36}, snapshot.settings, *snapshot.learned, snapshot.spp - 1);
    const PixelRect tile = grid.tile_at({24, 18});
    std::vector<int> columns;
    grid.shuffle_columns(tile, columns);
    std::vector<glm::vec3> colours;
    for (int pattern = 0; pattern < 3; ++pattern) {
        std::vector<glm::vec3> of_pattern;
        grid.for_each_rook(tile, columns, pattern, [&](int x, int y) {
            of_pattern.push_back(colour(shown, (corner(1, {x, y}) + corner(1, {x + 1, y + 1})) * 0.5f));
        });
        ASSERT_EQ(of_pattern.size(), 3u);
        EXPECT_EQ(of_pattern[1], of_pattern[0]) << pattern;
        EXPECT_EQ(of_pattern[2], of_pattern[0]) << pattern;
        for (const glm::vec3& other : colours)
            EXPECT_GT(glm::distance(of_pattern[0], other), 30) << pattern;
        colours.push_back(of_pattern[0]);
    }
}

TEST_F(Tiles, RooksAndSmallTilesAndZoom) {
    state().panes[1].settings.render.method = Method::pr;
    state().panes[1].settings.render.pattern = Pattern::rooks;
    state().display.show_tiles = true;
    wait_until([&] { return viewer.settled(3); });
    move_to((corner(1, {20, 16}) + corner(1, {21, 17})) * 0.5f);
    save("tiles-rooks.png");
    modifiers(true, false);
    wheel(14);
    modifiers(false, false);
    save("tiles-rooks-zoomed.png");
    state().panes[1].settings.render.tile = 1;
    wait_until([&] { return viewer.settled(3); });
    resize({60, 40}); // almost no space for a pane
    frames(3);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

} // namespace
} // namespace tessera::test
