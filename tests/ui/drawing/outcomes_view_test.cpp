// The buffer of shift outcomes: colours, legend and values.

#include "tests/ui/drawing/panes_fixture.h"
#include "ui/panes/pane_parts.h"
#include "ui/panes/showing.h"
#include "ui/state/inspected.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera::test {
namespace {

/// PR and G-PR at rest, showing outcomes.
struct OutcomesView : Panes {
    OutcomesView() {
        choose("pane0.method", "pr");
        wait_for_settled();
        type(Key::digit6);
        frames(2);
    }

    const ReuseMaps& maps(int index) { return *pane(index).snapshot->reuse; }
    static glm::vec3 colour_of(std::size_t outcome) {
        const ImU32 c = outcome_colour(static_cast<ShiftOutcome>(outcome));
        return {c & 255, c >> 8 & 255, c >> 16 & 255};
    }
    /// Returns the expected colour of a pixel: the colours of the outcomes, weighted by their fractions.
    glm::vec3 mean_colour(int index, int x, int y) {
        glm::vec3 sum(0);
        for (std::size_t i = 0; i < shift_outcome_count; ++i)
            sum += maps(index).share(static_cast<ShiftOutcome>(i))(x, y) * colour_of(i);
        return sum;
    }
};

TEST_F(OutcomesView, PixelsHaveTheMeanColourOfTheirShifts) {
    const ScreenPixels pixels = screen();
    float least = 255, most = 0; // green channel; the pixels differ
    for (int index : {0, 1}) {
        for (int y = 2; y < 36; y += 5) {
            for (int x = 2; x < 48; x += 5) {
                const glm::vec3 expected = mean_colour(index, x, y), at(middle_of(index, x, y), 0);
                const ControlRect legend = place("pane" + std::to_string(index) + ".legend");
                if (at.x > legend.min.x && at.x < legend.max.x && at.y > legend.min.y)
                    continue;
                EXPECT_LT(glm::distance(colour(pixels, at), expected), 3) << index << ": " << x << ',' << y;
                least = std::min(least, expected.g);
                most = std::max(most, expected.g);
            }
        }
    }
    EXPECT_GT(most, least + 30);
    save("outcomes.png");
}

TEST_F(OutcomesView, LegendNamesTheColours) {
    const ControlRect legend = place("pane1.legend"), picture = place("pane1.picture");
    EXPECT_GT(legend.min.x, picture.min.x);
    EXPECT_LT(legend.max.y, picture.max.y);
    EXPECT_LT(legend.max.x, picture.max.x);
    const ScreenPixels pixels = screen();
    for (std::size_t i = 0; i < shift_outcome_count; ++i) {
        int spot = 0; // number of pixels of this colour
        for (float y = legend.min.y; y < legend.max.y; ++y)
            for (float x = legend.min.x; x < legend.max.x; ++x)
                spot += glm::distance(colour(pixels, {x, y}), colour_of(i)) < 3;
        EXPECT_GT(spot, 20) << i;
    }
    move_to(legend.center()); // shows the tooltip
    EXPECT_TRUE(viewer.controls().tooltip_pending());
    drag({legend.max.x - 20, legend.max.y - 11}, {-30, 0}); // outcomes have no range to drag
    EXPECT_TRUE(state().display.ranges.empty());
}

TEST_F(OutcomesView, LegendsOfAWipeDoNotOverlap) {
    choose("pane0.buffer", "reused");
    click("pane0.picture");
    type(Key::v);
    for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(1900, 720)}) {
        resize(size);
        frames(3);
        ASSERT_TRUE(has("pane0.right_legend"));
        const ControlRect left = place("pane0.legend"), right = place("pane0.right_legend");
        EXPECT_TRUE(right.min.x >= left.max.x || right.max.y <= left.min.y) << size.x;
    }
    choose("pane0.buffer", "outcomes");
    choose("pane1.buffer", "reused");
    const ControlRect left = place("pane0.legend"), right = place("pane0.right_legend");
    EXPECT_TRUE(right.min.x >= left.max.x || right.max.y <= left.min.y);
    save("outcomes-wipe.png");
}

TEST_F(OutcomesView, ValuesUnderTheMouseAreFractions) {
    move_to(middle_of(1, 20, 12));
    for (int i : {0, 1}) {
        const std::string shares = outcome_shares(maps(i).counts(20, 12));
        EXPECT_NE(shares.find("ok "), std::string::npos);
        EXPECT_EQ(cursor_text(state(), viewer.pictures().images(), i), "(20, 12)  " + shares);
        EXPECT_TRUE(has("pane" + std::to_string(i) + ".value"));
    }
}

/// Differences of mean colours have no meaning, so the difference shows the fraction of failed shifts.
TEST_F(OutcomesView, DifferencesAreOfTheFailedFraction) {
    click("pane0.picture");
    type(Key::n);
    state().display.tone.exposure = 10; // only the sign is visible
    frames(2);
    const Image<float> a = maps(0).failed(), b = maps(1).failed();
    const ScreenPixels pixels = screen();
    int looked = 0;
    for (int y = 2; y < 28; y += 3) {
        for (int x = 2; x < 48; x += 3) {
            const float difference = a(x, y) - b(x, y);
            if (std::abs(difference) < 0.01f)
                continue;
            const glm::vec3 seen = colour(pixels, middle_of(0, x, y));
            EXPECT_EQ(difference > 0, seen.r > seen.b) << x << ',' << y << ' ' << difference;
            ++looked;
        }
    }
    EXPECT_GT(looked, 10);
}

TEST_F(OutcomesView, IsSavedInItsColours) {
    const CanvasShader shader;
    const ScreenPixels saved = view_picture(1, shader, viewer.pictures().images(), state());
    ASSERT_EQ(saved.size, state().request_size());
    EXPECT_LT(glm::distance(colour(saved, {20, 12}), mean_colour(1, 20, 12)), 3);
}

TEST_F(OutcomesView, PathTracingHasNoOutcomes) {
    choose("pane0.method", "pt");
    wait_for_settled();
    EXPECT_TRUE(viewer.pictures().image(0).empty());
    EXPECT_FALSE(has("pane0.legend"));
    move_to(middle_of(0, 20, 12));
    EXPECT_EQ(cursor_text(state(), viewer.pictures().images(), 0), "");
}

} // namespace
} // namespace tessera::test
