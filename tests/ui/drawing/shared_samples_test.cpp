// Panes with equal render settings share one render, which each reconstructs itself.

#include "tests/ui/viewer_harness.h"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

namespace tessera::test {
namespace {

struct SharedSamples : testing::Test, ViewerHarness {
    SharedSamples() : ViewerHarness({1280, 720}, 1, two_norms()) {
        state().linked = false;
        rest(4);
    }
    static ViewerOptions two_norms() {
        ViewerOptions options = two_panes();
        options.panes[0].render.method = Method::gpr;
        options.panes[0].reconstruction.norm = Norm::l2;
        options.panes[1].reconstruction.norm = Norm::l1;
        return options;
    }
    bool shares(int a, int b) {
        return pane(a).snapshot->images == pane(b).snapshot->images && pane(a).generation == pane(b).generation;
    }
    Norm norm(int i) { return pane(i).snapshot->reconstructed_with.norm; }
    void settle(int spp) {
        state().rendering.pace.spp_limit = spp;
        frames(2); // changes take effect
        wait_until([&] { return viewer.settled(spp); });
        frames(3);
    }
};

TEST_F(SharedSamples, PanesWithDifferentNormsShareARender) {
    EXPECT_TRUE(shares(0, 1));
    EXPECT_EQ(norm(0), Norm::l2);
    EXPECT_EQ(norm(1), Norm::l1);
    const RgbImage &a = pane(0).snapshot->reconstruction->image, &b = pane(1).snapshot->reconstruction->image;
    EXPECT_FALSE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    settle(8);
    EXPECT_TRUE(shares(0, 1));
    EXPECT_EQ(pane(1).snapshot->spp, 8);
    state().camera.orbit({20, 0}, 100);
    frames(2);
    settle(8);
    EXPECT_TRUE(shares(0, 1)) << "after the camera has moved";
}

TEST_F(SharedSamples, TheOtherPaneKeepsThemWhenTheRenderingPaneCloses) {
    const std::uint64_t generation = pane(1).generation;
    const auto images = pane(1).snapshot->images;
    state().panes[0].settings.render.tile = 3;
    settle(4);
    EXPECT_EQ(pane(1).generation, generation);
    EXPECT_EQ(pane(1).snapshot->images, images) << "the samples are kept";
    EXPECT_EQ(norm(1), Norm::l1);
    EXPECT_NE(pane(0).generation, generation);
    EXPECT_EQ(pane(0).snapshot->settings.tile, 3);
    state().panes[0].settings.render.tile = state().panes[1].settings.render.tile;
    settle(4);
    EXPECT_TRUE(shares(0, 1));
    EXPECT_EQ(pane(0).snapshot->images, images);
    EXPECT_EQ(norm(0), Norm::l2);
    state().active_pane = 1;
    state().set_pane_count(1);
    settle(4);
    EXPECT_EQ(pane(0).generation, generation);
    EXPECT_EQ(pane(0).snapshot->images, images);
}

TEST_F(SharedSamples, TwoClicksShowReconstructionsSideBySide) {
    state().active_pane = 1;
    const std::uint64_t generation = pane(1).generation;
    click("menu Panes");
    click("menu Panes/Compare reconstructions");
    settle(4);
    save("reconstructions.png");
    ASSERT_EQ(state().panes.size(), 4u);
    const Norm norms[] = {Norm::none, Norm::l1, Norm::weighted, Norm::guided};
    for (int i = 0; i < 4; ++i) {
        EXPECT_TRUE(shares(0, i)) << i;
        EXPECT_EQ(norm(i), norms[i]) << i;
    }
    EXPECT_EQ(pane(3).generation, generation) << "the same samples";
}

} // namespace
} // namespace tessera::test
