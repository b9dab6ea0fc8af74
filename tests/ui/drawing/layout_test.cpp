// The rendered size: panels around the pictures discard no samples.

#include "tests/ui/viewer_harness.h"

#include <cstdint>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

/// Two panes that fit their areas, at rest with many samples.
struct Layout : testing::Test, ViewerHarness {
    Layout() : ViewerHarness({400, 240}, 1, as_large_as_the_panes()) { rest(many); }

    static constexpr int many = 8;
    static ViewerOptions as_large_as_the_panes() {
        ViewerOptions options = two_panes();
        options.size = {SizeChoice::Base::pane, 0.2f, {}};
        return options;
    }
    bool waits_for_another_size() { return state().fitting_size() != state().request_size(); }
};

TEST_F(Layout, PanelsAndWindowSizeRestartNoRender) {
    const std::uint64_t first = pane(0).generation, second = pane(1).generation;
    const auto same = [&](const char* what) {
        frames(3);
        EXPECT_EQ(pane(0).generation, first) << what;
        EXPECT_EQ(pane(1).generation, second) << what;
        EXPECT_GT(brightness("pane1.picture"), 10) << what;
    };
    for (Key key : {Key::p, Key::h, Key::t, Key::h, Key::t, Key::p}) {
        type(key);
        same("a panel");
    }
    EXPECT_FALSE(waits_for_another_size()); // the size fits again
    type(Key::o);
    EXPECT_TRUE(waits_for_another_size());
    same("one pane alone");
    save("scaled-up.png");
    type(Key::o);
    resize({700, 500});
    EXPECT_TRUE(waits_for_another_size());
    same("the window");
    EXPECT_TRUE(has("fitting_pixels"));
    type(Key::up, true);
    same("larger text");
}

TEST_F(Layout, ABottomPanelDoesNotCoverThePictures) {
    const std::uint64_t before = pane(0).generation;
    const float without = place("pane0.picture").max.y;
    type(Key::i);
    frames(3);
    EXPECT_LE(place("pane0.picture").max.y, place("inspector.direction").min.y);
    EXPECT_EQ(pane(0).generation, before);
    resize({400, 40}); // hardly enough space for both
    EXPECT_LT(place("pane0.picture").min.y, place("pane0.picture").max.y);
    resize({400, 240});
    type(Key::i);
    frames(3);
    EXPECT_EQ(place("pane0.picture").max.y, without);
}

TEST_F(Layout, ABetterSizeIsUsedAtARestart) {
    resize({700, 500});
    ASSERT_TRUE(waits_for_another_size());
    type(Key::r);
    EXPECT_FALSE(waits_for_another_size());
    wait_until([&] { return viewer.settled(many); });

    resize({400, 240});
    state().panes[0].settings.render.method =
        Method::pr; // one pane restarts, but the other would lose its samples
    const std::uint64_t other = pane(1).generation;
    frames(2);
    EXPECT_TRUE(waits_for_another_size());
    EXPECT_EQ(pane(1).generation, other);
    state().camera.dolly(0.9f); // restarts all panes
    frames(2);
    EXPECT_FALSE(waits_for_another_size());
}

TEST_F(Layout, AChosenSizeIsUsedAtOnce) {
    const std::uint64_t before = pane(0).generation;
    state().rendering.size = {SizeChoice::Base::custom, 1, {30, 20}};
    frames(2);
    EXPECT_EQ(state().request_size(), glm::ivec2(30, 20));
    EXPECT_GT(pane(0).generation, before);
}

TEST_F(Layout, AtTheStartABetterSizeIsUsedAtOnce) {
    state().rendering.pace.spp_limit = 2;
    type(Key::r);
    wait_until([&] { return viewer.settled(2); });
    resize({700, 500});
    EXPECT_FALSE(waits_for_another_size());
}

// A first pass can take a minute and be nearly complete.
TEST_F(Layout, PanelsDoNotRestartAFirstPass) {
    state().rendering.paused = true; // before its first pass
    type(Key::r);
    frames(2);
    for (int spp : {0, 2}) {
        if (spp > 0) {
            state().rendering.pace.spp_limit = spp;
            state().rendering.paused = false;
            ASSERT_TRUE(wait_until([&] { return viewer.settled(spp); }));
        }
        const std::uint64_t first = pane(0).generation, second = pane(1).generation;
        const glm::ivec2 size = state().request_size();
        for (Key key : {Key::i, Key::h, Key::t, Key::o, Key::o, Key::p, Key::t, Key::h, Key::i, Key::p}) {
            type(key);
            frames(2);
            EXPECT_EQ(pane(0).generation, first) << spp;
            EXPECT_EQ(pane(1).generation, second) << spp;
            EXPECT_EQ(state().request_size(), size) << spp;
        }
    }
}

TEST_F(Layout, AnAddedPaneHasTheSizeOfTheOthers) {
    const std::uint64_t before = pane(0).generation;
    type(Key::digit4, true);
    wait_until([&] { return viewer.settled(many); });
    EXPECT_EQ(pane(0).generation, before);
    EXPECT_EQ(viewer.pictures().image(3).pixels().width(), viewer.pictures().image(0).pixels().width());
}

} // namespace
} // namespace tessera::test
