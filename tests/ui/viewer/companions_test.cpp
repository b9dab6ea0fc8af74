// Buffers that need data beside snapshots: errors against a reference, first hits.

#include "render/io/exr.h"
#include "render/run/first_hits.h"
#include "render/scene/scene.h"
#include "tests/ui/viewer_harness.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

namespace tessera::test {
namespace {

struct CompanionsTest : testing::Test, ViewerHarness {
    CompanionsTest() { rest(3); }
    ~CompanionsTest() override { std::filesystem::remove(file_); }

    /// Drops a grey reference of this size on the window.
    void drop_reference(glm::ivec2 size, float value) {
        write_exr(file_, {{{"", RgbImage(size.x, size.y, Rgb(value))}}, {}});
        viewer.drop({file_});
        wait_until([&] { return state().companions.reference != nullptr; });
        frames(3);
    }

    /// Whether the state has complete first hits other than these.
    bool is_other_than(const std::shared_ptr<const FirstHits>& before) {
        const auto& hits = state().companions.first_hits;
        return hits && hits != before && hits->depth.width() == 48;
    }

    std::filesystem::path file_ =
        std::filesystem::temp_directory_path() / ("tessera-reference-" + std::to_string(::getpid()) + ".exr");
};

TEST_F(CompanionsTest, ErrorsAgainstADroppedReference) {
    type(Key::digit7);
    EXPECT_TRUE(viewer.pictures().image(0).empty());
    save("no-reference.png");
    drop_reference({48, 36}, 0.5f);
    ASSERT_FALSE(viewer.pictures().image(0).empty());
    const Rgb value = pane(0).snapshot->reconstruction->image(10, 10);
    float expected = 0;
    for (int i = 0; i < 3; ++i)
        expected += (value[i] - 0.5f) * (value[i] - 0.5f) / (0.251f * 3);
    EXPECT_NEAR(viewer.pictures().image(0).pixels()(10, 10).r, expected, 1e-4f * expected);
    EXPECT_TRUE(has("pane0.legend"));
    EXPECT_TRUE(viewer.pictures().image(1).range().logarithmic);
    save("error.png");

    // After a drag, the range remains logarithmic and common to all panes.
    const ControlRect legend = place("pane0.legend");
    drag({legend.max.x - 20, legend.max.y - 11}, {30, 0});
    const ValueRange range = state().display.ranges.at(Buffer::error_relative_squared);
    EXPECT_TRUE(range.logarithmic);
    EXPECT_GT(range.high, 1);
    command("Error: absolute");
    EXPECT_EQ(pane(1).settings.buffer, Buffer::error_absolute);
}

TEST_F(CompanionsTest, AReferenceOfAnotherSizeOffersItsSize) {
    command("Error: squared");
    drop_reference({40, 20}, 0.5f);
    EXPECT_TRUE(viewer.pictures().image(0).empty());
    ASSERT_TRUE(has("reference_size"));
    click("reference_size");
    EXPECT_EQ(state().request_size(), glm::ivec2(40, 20));
    wait_until([&] { return viewer.settled(3); });
    frames(3);
    EXPECT_FALSE(viewer.pictures().image(0).empty());
    EXPECT_FALSE(has("reference_size"));
}

TEST_F(CompanionsTest, TheReferenceCanBeShownAndCompared) {
    type(Key::digit8);
    EXPECT_EQ(pane(0).settings.buffer, Buffer::reference);
    EXPECT_TRUE(viewer.pictures().image(0).empty());
    drop_reference({20, 10}, 0.25f); // of any size
    ASSERT_FALSE(viewer.pictures().image(0).empty());
    EXPECT_EQ(viewer.pictures().image(1).at({0.9f, 0.9f}), Rgb(0.25f));

    type(Key::digit2); // primal
    click("pane0.picture");
    choose("compare_with", "reference");
    EXPECT_EQ(state().compared_with(0), the_reference);
    choose("compare", "wipe");
    EXPECT_EQ(value_at(showing_at(state(), 0, 0.9f), viewer.pictures().images(), {0.9f, 0.4f}), Rgb(0.25f));
    EXPECT_EQ(label_of(showing_at(state(), 0, 0.9f), state()), "Reference");
    state().display.show_tiles = state().display.magnifier = state().inspector.active =
        true; // these use the pane under the mouse
    const ControlRect rect = place("pane0.picture");
    click(rect.min + (rect.max - rect.min) * glm::vec2(0.7f, 0.5f));
    EXPECT_EQ(state().inspector.sample->slot, 0);
    save("wipe-reference.png");
    state().display.show_tiles = state().display.magnifier = state().inspector.active = false;
    choose("compare", "difference");
    const Rgb primal = viewer.pictures().image(0).at({0.5f, 0.5f});
    EXPECT_EQ(value_at(showing_at(state(), 0, 0.5f), viewer.pictures().images(), {0.5f, 0.5f}),
              primal - Rgb(0.25f));
    choose("compare", "off");
    viewer.keyboard().press(Key::b, Key::b, false, false); // flicker
    frames(2);
    EXPECT_EQ(showing_at(state(), 0, 0.5f).pane, the_reference);
    viewer.keyboard().release(Key::b);
    type(Key::digit1, true); // a single pane can be compared with the reference only
    EXPECT_EQ(state().compared_with(0), the_reference);
    EXPECT_TRUE(has("compare"));
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(CompanionsTest, TheHalvesOfAReferenceAreRead) {
    const RgbImage grey(48, 36, Rgb(0.5f));
    write_exr(file_,
              {{{"", grey}, {"half1", RgbImage(48, 36, Rgb(0.4f))}, {"half2", RgbImage(48, 36, Rgb(0.6f))}}, {}});
    viewer.drop({file_});
    wait_until([&] { return state().companions.reference != nullptr; });
    const Reference& reference = *state().companions.reference;
    EXPECT_EQ(reference.halves[0](7, 7), Rgb(0.4f));
    EXPECT_EQ(reference.halves[1](7, 7), Rgb(0.6f));
    EXPECT_EQ(reference.mean, luminance(Rgb(0.5f)));
}

TEST_F(CompanionsTest, AReferenceOfAnotherSceneIsLoadedWithAMessage) {
    const auto load = [&](const std::string& scene) {
        const auto before = state().companions.reference;
        write_exr(file_, {{{"", RgbImage(48, 36, Rgb(0.5f))}}, {{"tessera:scene", scene}}});
        viewer.drop({file_});
        wait_until([&] { return state().companions.reference != before; });
    };
    const auto said = [&] {
        return std::count_if(state().messages.begin(), state().messages.end(), [](const Message& m) {
            return m.text.find("The reference and the panes differ in their lights") != m.text.npos;
        });
    };
    SceneChecksums sums = checksums_of(state().scene->description(), state().camera.camera());
    load(to_string(sums));
    load("nonsense"); // a file without scene checksums
    const auto plain = state().companions.reference;
    EXPECT_FALSE(plain->scene);
    ++sums.lights;
    load(to_string(sums));
    ASSERT_TRUE(wait_until([&] { return said() == 1; }));
    EXPECT_NE(state().companions.reference, plain);
    EXPECT_EQ(state().messages.back().kind, Message::Kind::error);
    frames(2);
    save("reference-of-another-scene.png");
    viewer.load("another", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
    EXPECT_TRUE(wait_until([&] { return said() == 0; })) << "the message belonged to the other scene";
    EXPECT_TRUE(wait_until([&] { return said() == 1; })) << "the reference differs from this scene, too";
}

TEST_F(CompanionsTest, ReadingAReferenceShowsProgressAndCanBeCancelled) {
    drop_reference({48, 36}, 0.5f);
    const auto before = state().companions.reference;
    const auto expect_given_up = [&] {
        EXPECT_FALSE(state().reference_read);
        EXPECT_NE(state().messages.back().text.find("was cancelled"), std::string::npos);
        frames(20);
        EXPECT_EQ(state().companions.reference, before);
        EXPECT_FALSE(has("reading"));
        state().messages.clear();
    };
    viewer.drop({file_});
    frame();
    ASSERT_TRUE(state().reference_read); // complete or not, its outcome is not taken yet
    viewer.keyboard().press(Key::escape, Key::escape, false, false);
    viewer.keyboard().release(Key::escape);
    frame();
    EXPECT_TRUE(has("reading")); // drawn from the state at the beginning of the frame
    save("reading.png");
    frame();
    expect_given_up();

    state().layout.show_help = true; // Esc only closes the help
    viewer.drop({file_});
    frame();
    viewer.keyboard().press(Key::escape, Key::escape, false, false);
    frame();
    EXPECT_FALSE(state().layout.show_help);
    EXPECT_TRUE(wait_until([&] { return state().companions.reference != before; }));
    EXPECT_FALSE(state().reference_read);
}

TEST_F(CompanionsTest, ABrokenReferenceGivesAMessage) {
    viewer.drop({"/nowhere/reference.exr"});
    wait_until([&] { return !state().messages.empty(); });
    EXPECT_NE(state().messages.back().text.find("/nowhere/reference.exr"), std::string::npos);
    EXPECT_EQ(state().messages.back().kind, Message::Kind::error);
}

TEST_F(CompanionsTest, FootprintsAreTracedWhenShown) {
    state().panes[0].settings.buffer = Buffer::depth;
    wait_until([&] {
        const auto& hits = state().companions.first_hits;
        return hits && hits->depth.width() == 48;
    });
    EXPECT_TRUE(state().companions.first_hits->footprint_1.empty());
    state().panes[0].settings.buffer = Buffer::footprint_2;
    wait_until([&] {
        const auto& hits = state().companions.first_hits;
        return hits && hits->footprint_2.width() == 48;
    });
    frames(2);
    EXPECT_GT(brightness("pane0.picture"), 10);
    EXPECT_TRUE(has("pane0.legend"));
    save("footprint.png");
}

TEST_F(CompanionsTest, FirstHitsFollowTheCamera) {
    EXPECT_EQ(state().companions.first_hits, nullptr); // no pane shows them
    command("Depth");
    EXPECT_EQ(pane(0).settings.buffer, Buffer::depth);
    std::vector<int> widths; // a preview with a quarter of the width comes first
    wait_until([&] {
        const auto& hits = state().companions.first_hits;
        if (hits && (widths.empty() || widths.back() != hits->depth.width()))
            widths.push_back(hits->depth.width());
        return hits && hits->depth.width() == 48;
    });
    EXPECT_EQ(widths, (std::vector<int>{12, 48}));
    frames(2);
    const auto before = state().companions.first_hits;
    EXPECT_NEAR(before->depth(24, 30), 3.5f, 1.5f);
    EXPECT_GT(brightness("pane0.picture"), 10);
    EXPECT_TRUE(has("pane0.legend")); // also for PT
    save("depth.png");
    state().camera.dolly(0.5f);
    wait_until([&] { return is_other_than(before); });
    EXPECT_LT(state().companions.first_hits->depth(24, 4), before->depth(24, 4));
    command("Normal");
    frames(2);
    save("normal.png");
    command("Albedo");
    frames(2);
    save("albedo.png");
    const auto near = state().companions.first_hits;
    state().camera.go_home();
    wait_until([&] { return is_other_than(near); });
    frames(2);
    // The albedo of the red wall does not depend on light.
    const Rgb red = viewer.pictures().image(0).pixels()(1, 18);
    EXPECT_NEAR(red.r, 0.63f, 0.02f);
    EXPECT_NEAR(red.g, 0.065f, 0.01f);
}

TEST_F(CompanionsTest, FirstHitsOfAnOlderViewAreMarked) {
    const auto legend_width = [&] {
        const ControlRect rect = place("pane0.legend");
        return rect.max.x - rect.min.x;
    };
    command("Depth");
    wait_until([&] { return is_other_than(nullptr); });
    EXPECT_EQ(viewer.next_frame_in(), 0); // the next frame shows them
    frames(3);
    EXPECT_GT(viewer.next_frame_in(), 1);
    EXPECT_FALSE(state().companions.first_hits_are_earlier);
    const float unmarked = legend_width();
    state().camera.dolly(0.5f);
    frame();
    EXPECT_TRUE(state().companions.first_hits_are_earlier);
    frame();
    EXPECT_GT(legend_width(), unmarked);
    save("earlier-depth.png");
    wait_until([&] { return !state().companions.first_hits_are_earlier; });
    frames(2);
    EXPECT_EQ(legend_width(), unmarked);

    // Albedo has no other legend.
    command("Albedo");
    frames(2);
    EXPECT_FALSE(has("pane0.legend"));
    state().companions.first_hits_are_earlier = true; // until the next update
    frame();
    EXPECT_TRUE(has("pane0.legend"));
    save("earlier-albedo.png");
    frame();
    EXPECT_FALSE(has("pane0.legend"));
}

TEST_F(CompanionsTest, FirstHitsOfAReplacedSceneAreDropped) {
    command("Depth");
    wait_until([&] { return is_other_than(nullptr); });
    const std::weak_ptr<const Scene> before = state().scene;
    const auto old = state().companions.first_hits;
    type(Key::digit1); // no pane shows them
    viewer.load("another", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
    wait_until([&] { return state().scene != before.lock() && viewer.settled(3); });
    frames(2);
    EXPECT_EQ(state().companions.first_hits, nullptr);
    EXPECT_TRUE(wait_until([&] { return before.expired(); }));
    command("Depth");
    EXPECT_TRUE(wait_until([&] { return is_other_than(old); }));
}

} // namespace
} // namespace tessera::test
