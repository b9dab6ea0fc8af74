#include "ui/gl/image_view.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

constexpr glm::ivec2 image(320, 180), pane(500, 400);

TEST(ImageView, PictureIsFittedAndCentred) {
    const Placement p = ImageView().place(image, pane);
    EXPECT_FLOAT_EQ(p.extent.x, 500);
    EXPECT_NEAR(p.extent.y, 281.25f, 0.01f);
    EXPECT_NEAR(p.origin.y, (400 - 281.25f) / 2, 1);
}

TEST(ImageView, NearlyFittingPictureHasOnePixelPerUnit) {
    const Placement p = ImageView().place({480, 270}, {500, 400});
    EXPECT_EQ(p.extent, glm::vec2(480, 270));
    EXPECT_EQ(p.origin, glm::vec2(10, 65));
}

TEST(ImageView, ZoomKeepsThePointUnderTheCursor) {
    ImageView view;
    const glm::vec2 cursor(310, 250);
    view.zoom_at(cursor, 4, image, pane);
    const glm::vec2 before = view.place(image, pane).to_image(cursor);
    view.zoom_at(cursor, 1.5f, image, pane);
    const glm::vec2 after = view.place(image, pane).to_image(cursor);
    EXPECT_LT(glm::length(before - after), 1.0f / 500); // the picture begins at whole screen pixels
    EXPECT_FLOAT_EQ(view.zoom(), 6);
}

TEST(ImageView, PanMovesByPixels) {
    ImageView view;
    view.zoom_at({250, 200}, 8, image, pane);
    const Placement before = view.place(image, pane);
    view.pan({40, -25}, image, pane);
    const glm::vec2 moved = view.place(image, pane).origin - before.origin;
    EXPECT_NEAR(moved.x, 40, 1);
    EXPECT_NEAR(moved.y, -25, 1);
}

TEST(ImageView, PanKeepsThePictureVisible) {
    ImageView view;
    for (int i = 0; i < 100; ++i)
        view.pan({1000, 1000}, image, pane);
    const Placement p = view.place(image, pane);
    EXPECT_LE(p.origin.x, 250);
    EXPECT_LE(p.origin.y, 200);
    for (int i = 0; i < 100; ++i)
        view.zoom_at({0, 0}, 0.1f, image, pane);
    EXPECT_GE(view.zoom(), 0.2f);
    view.fit();
    EXPECT_EQ(view, ImageView());
}

TEST(ImageView, SameFractionForImagesOfDifferentSizes) {
    ImageView view;
    view.zoom_at({100, 100}, 3, image, pane);
    const Placement large = view.place(image, pane), small = view.place(image / 4, pane);
    EXPECT_LT(glm::length(large.extent - small.extent), 0.01f);
    EXPECT_EQ(large.origin, small.origin);
}

TEST(ImageView, DegenerateSizesAreHarmless) {
    ImageView view;
    view.zoom_at({0, 0}, 2, {0, 0}, {1, 1});
    view.pan({5, 5}, {1, 1}, {0, 0});
    EXPECT_EQ(view.place({0, 0}, {10, 10}).extent, glm::vec2(0));
    EXPECT_EQ(ImageView().place({1, 1}, {1, 1}).extent, glm::vec2(1));
}

} // namespace
} // namespace tessera
