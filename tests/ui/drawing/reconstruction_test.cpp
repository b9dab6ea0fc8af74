// Long reconstructions: progress and cancellation.

#include "tests/ui/viewer_harness.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {
namespace {

bool has_message(const ViewerState& state, const std::string& part) {
    return std::any_of(state.messages.begin(), state.messages.end(),
                       [&](const Message& m) { return m.text.find(part) != std::string::npos; });
}

TEST(LongReconstruction, IsCancelledByEscape) {
    ViewerOptions options;
    options.panes.resize(1);
    options.panes[0].render.method = Method::gpt;
    options.panes[0].reconstruction.norm = Norm::none;
    options.max_depth = 1;
    options.size = {SizeChoice::Base::custom, 1, {1280, 720}};
    options.spp_limit = 1;
    ViewerHarness h({900, 600}, 1, options);
    h.state().rendering.patience = 0;
    h.viewer.load("a room", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
    ASSERT_TRUE(h.wait_until([&] { return h.viewer.settled(1); }));
    const auto before = h.pane(0).snapshot->reconstruction;
    h.state().panes[0].settings.reconstruction.norm = Norm::l1; // takes half a second on an idle machine
    ASSERT_TRUE(h.wait_until([&] { return h.pane(0).reconstructing.has_value(); }));
    EXPECT_LE(h.viewer.next_frame_in(), 0.1); // the elapsed time is updated
    h.type(Key::f1);
    h.type(Key::escape); // only closes the help
    EXPECT_FALSE(has_message(h.state(), "was cancelled"));
    h.type(Key::escape);
    EXPECT_TRUE(has_message(h.state(), "G-PT: the reconstruction of pass 1 was cancelled."));
    ASSERT_TRUE(h.wait_until([&] { return !h.pane(0).reconstructing; }));
    h.frames(5);
    EXPECT_FALSE(h.pane(0).reconstructing); // and it does not start again
    EXPECT_EQ(h.pane(0).snapshot->reconstruction, before);
    h.state().panes[0].settings.reconstruction.norm = Norm::none;
    EXPECT_TRUE(h.wait_until([&] { return h.viewer.settled(1); }));
}

} // namespace
} // namespace tessera::test
