// Comparison of panes: the line of a wipe, legends, and missing pictures.

#include "tests/ui/drawing/panes_fixture.h"
#include "ui/panes/showing.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera::test {
namespace {

using Compare = Panes;

TEST_F(Compare, TheLineFollowsTheMouseBackFromBeyondAnEnd) {
    click("pane0.picture");
    type(Key::v);
    const ControlRect rect = place("pane0.picture");
    const float width = rect.max.x - rect.min.x;
    const glm::vec2 grip = point(0, 0.5f, 0.6f) + glm::vec2(7, 0);
    move_to(grip);
    press();
    move_to(grip + glm::vec2(-width, 0));
    EXPECT_EQ(state().layout.wipe, 0);
    move_to(grip + glm::vec2(-0.2f * width, 0));
    release();
    EXPECT_NEAR(state().layout.wipe, 0.3f, 0.01f); // not 0.8, the sum of the steps
}

TEST_F(Compare, AnEndOfARangeFollowsTheMouseBackFromBeyondTheOther) {
    choose("pane1.buffer", "reused");
    const ControlRect legend = place("pane1.legend");
    const glm::vec2 grip(legend.min.x + 20, legend.max.y - 11);
    move_to(grip);
    press();
    move_to(grip + glm::vec2(4000, 0));
    move_to(grip + glm::vec2(30, 0));
    const ValueRange once_beyond = state().display.ranges.at(Buffer::reused);
    release();
    frame(1); // prevents a double click with the next click
    state().display.ranges.clear();
    drag(grip, {30, 0});
    EXPECT_EQ(state().display.ranges.at(Buffer::reused), once_beyond);
}

TEST_F(Compare, EachSideOfAWipeHasItsLegend) {
    choose("pane0.method", "pr");
    choose("pane0.buffer", "reused");
    choose("pane1.buffer", "survival");
    wait_for_settled();
    click("pane0.picture");
    type(Key::v);
    EXPECT_TRUE(has("pane0.legend"));
    ASSERT_TRUE(has("pane0.right_legend"));
    const ControlRect left = place("pane0.legend"), right = place("pane0.right_legend");
    EXPECT_GT(right.max.x, left.max.x);
    EXPECT_TRUE(right.min.x >= left.max.x || right.max.y <= left.min.y);
    save("wipe-legends.png");
    const ControlRect legend = place("pane0.right_legend");
    drag({legend.max.x - 20, legend.max.y - 11}, {-30, 0});
    EXPECT_EQ(state().display.ranges.count(Buffer::reused), 0u);
    EXPECT_EQ(state().display.ranges.count(Buffer::survival), 1u);
    state().layout.wipe = 0;
    frames(2);
    EXPECT_FALSE(has("pane0.legend")); // that side is not visible
    EXPECT_TRUE(has("pane0.right_legend"));
    state().layout.wipe = 0.5f;
    choose("pane0.buffer", "survival");
    EXPECT_TRUE(has("pane0.legend"));
    EXPECT_FALSE(has("pane0.right_legend")); // both sides share one
}

TEST_F(Compare, GradientsAndDifferencesHaveALegend) {
    choose("pane1.buffer", "dx");
    EXPECT_TRUE(has("pane1.legend"));
    const ControlRect legend = place("pane1.legend");
    const ScreenPixels pixels = screen();
    const float y = legend.max.y - 11;
    const glm::vec3 low = colour(pixels, {legend.min.x + 10, y}), high = colour(pixels, {legend.max.x - 10, y});
    EXPECT_GT(low.b, low.r + 50);
    EXPECT_GT(high.r, high.b + 50);
    save("signed-legend.png");
    click("pane0.picture");
    type(Key::n);
    EXPECT_TRUE(has("pane0.legend"));
    choose("pane0.buffer", "dx"); // PT has no gradients
    EXPECT_FALSE(has("pane0.legend"));
}

TEST_F(Compare, ADifferenceWithoutASubtrahendShowsNothing) {
    choose("pane0.buffer", "dx"); // PT has no gradients
    choose("pane1.buffer", "dx");
    click("pane1.picture");
    type(Key::n);
    move_to(point(1, 0.5f, 0.4f));
    const Showing difference = showing_at(state(), 1, 0.5f);
    ASSERT_EQ(difference.subtrahend, 0);
    EXPECT_FALSE(value_at(difference, viewer.pictures().images(), {0.5f, 0.5f}));
    EXPECT_FALSE(has("pane1.value"));
    EXPECT_EQ(missing_text(difference, state()), "PT measures no gradients");
    const ScreenPixels pixels = screen();
    for (float x : {0.3f, 0.5f, 0.7f}) // avoiding the text in the middle
        EXPECT_LT(glm::distance(colour(pixels, point(1, x, 0.35f)), glm::vec3(14, 15, 17)), 3) << x;
    save("no-subtrahend.png");
}

TEST_F(Compare, TheRightSideOfAWipeShowsItsMissingText) {
    choose("pane0.buffer", "dx");
    click("pane1.picture");
    type(Key::v);
    state().layout.wipe = 0.2f;
    frames(2);
    save("no-right-side.png");
    const ScreenPixels pixels = screen();
    float brightest = 0; // of light text on dark ground
    for (float x = 0.25f; x < 0.98f; x += 0.002f)
        for (float y = 0.47f; y < 0.53f; y += 0.004f)
            brightest = std::max(brightest, colour(pixels, point(1, x, y)).g);
    EXPECT_GT(brightest, 80);
}

// The range is the same in all panes and during a request, so that equal values have equal colours.
TEST_F(Compare, FalseColoursAreComparableBetweenPanesAndPasses) {
    choose("pane0.method", "pr");
    command("Variance of primal");
    wait_for_settled();
    const auto shared = [&] { return range_of(Buffer::primal_variance, state(), viewer.pictures().images()); };
    const ValueRange range = shared(),
                     own[] = {viewer.pictures().image(0).range(), viewer.pictures().image(1).range()};
    ASSERT_NE(own[0], own[1]);
    EXPECT_EQ(range.low, std::min(own[0].low, own[1].low));
    EXPECT_EQ(range.high, std::max(own[0].high, own[1].high));
    state().rendering.pace.spp_limit = 60; // the variances fall by a factor of 20
    wait_until([&] { return viewer.settled(60); });
    frames(2);
    EXPECT_EQ(shared(), range);
    save("variances.png");
    state().wishes.restart = true;
    frame(); // sends the request; before, the old request is settled
    wait_for_settled();
    EXPECT_NE(shared(), ValueRange());
}

} // namespace
} // namespace tessera::test
