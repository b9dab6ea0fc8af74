// The line below a picture.

#include "tests/ui/viewer_harness.h"
#include "ui/panes/pane_parts.h"

#include <memory>

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(PaneStatus, ShowsMethodSamplesTimeAndRays) {
    ViewerState state;
    PaneState& pane = state.panes.emplace_back();
    pane.settings.render.method = Method::gpr;
    EXPECT_EQ(status_text(state, 0), "G-PR   no scene");
    state.scene_info.loading = "reading";
    EXPECT_EQ(status_text(state, 0), "G-PR   waiting for the scene");
    state.scene_info.loading.clear();
    state.scene = test::viewer_scene();
    EXPECT_EQ(status_text(state, 0), "G-PR   starting");
    pane.generation = 3;
    pane.pass_progress = 0.371f;
    EXPECT_EQ(status_text(state, 0), "G-PR   preview 37 %");
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->generation = pane.generation = 4;
    snapshot->spp = 12;
    snapshot->seconds = 2;
    snapshot->settings.method = Method::gpr;
    snapshot->counters.rays = {1000000, 0, 2000000, 2000000};
    auto reconstruction = std::make_shared<Reconstruction>();
    reconstruction->iterations = 14;
    reconstruction->seconds = 0.0214;
    snapshot->reconstruction = reconstruction;
    snapshot->reconstruction_spp = 11;
    pane.snapshot = snapshot;
    EXPECT_EQ(status_text(state, 0),
              "G-PR   12 spp   2.00 s   2.5 Mrays/s   reconstruction of pass 11, 14 steps in 0.021 s");
    reconstruction->iterations = 1;
    EXPECT_NE(status_text(state, 0).find("pass 11, 1 step in"), std::string::npos);
    const auto says = [&](const char* word) { return status_text(state, 0).find(word) != std::string::npos; };
    EXPECT_FALSE(says("fireflies"));
    reconstruction->redistributed = 0.77;
    EXPECT_TRUE(says("fireflies: 77 % redistributed"));
    EXPECT_EQ(status_help(state, 0),
              "Method: G-PR\nSamples per pixel: 12 spp\nWall time of this pane's passes: 2.00 s\n"
              "Rays per second: 2.5 Mrays/s\nReconstruction (pass, solver steps, wall time): "
              "reconstruction of pass 11, 1 step in 0.021 s\nfireflies: 77 % redistributed");
    reconstruction->redistributed = 0;
    pane.reconstructing = {12, 0.2, 0.06f};
    EXPECT_FALSE(says("reconstructing"));
    pane.reconstructing = {12, 1.34, 0.4f};
    EXPECT_TRUE(says("G-PR   reconstructing pass 12, 40 %, 1.3 s (Esc ends it)   12 spp"));
    EXPECT_FALSE(says("pass 11"));
    state.rendering.paused = true;
    EXPECT_TRUE(says("paused"));
    state.rendering.paused = false;
    state.rendering.pace.spp_limit = 12;
    EXPECT_TRUE(says("done"));
    pane.failed = true;
    EXPECT_TRUE(says("failed"));
    pane.generation = 5; // no pass of this request is complete
    EXPECT_EQ(status_text(state, 0), "G-PR   failed: see the messages (F2)");
}

TEST(PaneStatus, LabelDistinguishesRawSamplesAndDenoisedPictures) {
    PaneSettings pane;
    const auto label = [&](Method method, Norm norm) {
        pane.render.method = method;
        pane.reconstruction.norm = norm;
        return sample_label(pane);
    };
    EXPECT_EQ(label(Method::gpr, Norm::guided), "denoised");
    EXPECT_EQ(label(Method::gpt, Norm::oidn), "denoised");
    EXPECT_EQ(label(Method::gpr, Norm::none), "raw samples");
    EXPECT_EQ(label(Method::gpt, Norm::l2), "raw samples, L2");
    EXPECT_EQ(label(Method::gpt, Norm::weighted), "raw samples, weighted");
    EXPECT_EQ(label(Method::pt, Norm::guided), "raw samples");
    EXPECT_EQ(label(Method::pr, Norm::l1), "raw samples");
    EXPECT_EQ(label(Method::pt, Norm::smoothed), "denoised");
}

TEST(PaneStatus, PanesStartWithTheDefaultsOfTheirMethods) {
    for (const PaneSettings& pane : default_panes(4))
        EXPECT_EQ(applied_norm(pane), default_norm(has_gradients(pane.render.method)));
}

TEST(PaneStatus, NamesThePaneThatOthersWaitFor) {
    ViewerState state;
    state.scene = test::viewer_scene();
    state.panes.resize(3);
    const auto had = [&](std::size_t pane, int spp, double seconds) {
        auto snapshot = std::make_shared<Snapshot>();
        snapshot->generation = state.panes[pane].generation = 7;
        snapshot->spp = spp;
        snapshot->seconds = seconds;
        state.panes[pane].snapshot = snapshot;
    };
    had(0, 900, 600);
    had(1, 40, 190);
    had(2, 800, 599);
    EXPECT_EQ(waiting_text(state, 0), "equal time: waiting for pane 2 (190 of 600 s)");
    EXPECT_EQ(waiting_text(state, 1), "");
    EXPECT_EQ(waiting_text(state, 2), "equal time: waiting for pane 2 (190 of 599 s)");
    EXPECT_NE(status_text(state, 0).find("waiting for pane 2"), std::string::npos);
    state.panes[1].generation = 8; // a new request without samples
    EXPECT_EQ(waiting_text(state, 0), "equal time: waiting for pane 2 (0 of 600 s)");
    state.rendering.pace.equal = Pace::Equal::spp;
    had(1, 40, 190);
    EXPECT_EQ(waiting_text(state, 0), "equal samples: waiting for pane 2 (40 of 900 spp)");
    state.rendering.pace.spp_limit = 40; // panes do not wait for a pane at its limit
    EXPECT_EQ(waiting_text(state, 0), "");
    state.rendering.pace.spp_limit = 0;
    state.panes[1].failed = true;
    EXPECT_EQ(waiting_text(state, 0), "equal samples: waiting for pane 3 (800 of 900 spp)");
    state.rendering.paused = true;
    EXPECT_EQ(waiting_text(state, 0), "");
}

} // namespace
} // namespace tessera
