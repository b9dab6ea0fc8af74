// "Make reference": renders in the background, bit-identical to `tessera reference`, and can be resumed.

#include "render/run/reference_render.h"
#include "tests/ui/viewer/current_folder.h"
#include "tests/ui/viewer_harness.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

struct MakeReference : testing::Test {
    CurrentFolder folder;
    ViewerHarness h;

    MakeReference() { h.rest(2); }

    /// Opens the dialog, sets the number of samples, and starts the render.
    static void begin(ViewerHarness& viewer, int spp) {
        viewer.type(Key::m, true);
        EXPECT_TRUE(viewer.state().reference_making.show);
        viewer.state().reference_making.spp = spp;
        viewer.click("reference.make");
    }
    static fs::path file(ViewerHarness& viewer) { return default_reference_file(viewer.state()); }
    static void wait_for_samples(ViewerHarness& viewer, int spp) {
        viewer.wait_until([&] {
            const auto& progress = viewer.state().reference_making.progress;
            return progress && progress->spp >= spp;
        });
    }
    static void wait_for_end(ViewerHarness& viewer) {
        viewer.wait_until([&] { return !viewer.state().reference_making.is_making(); });
    }

    /// Returns the checksum of the reference that the command renders with these settings.
    static std::uint32_t expected(ViewerHarness& viewer, int spp) {
        ReferenceRecipe recipe;
        recipe.size = viewer.state().request_size();
        recipe.spp = spp;
        recipe.settings.max_depth = viewer.pane(0).settings.render.max_depth;
        ThreadPool pool(2);
        const auto scene = viewer.state().scene;
        ReferenceRender render("other.exr", {{}, scene, viewer.state().camera.camera()}, recipe, pool);
        render.run([](const ReferenceRender&) { return true; });
        return checksum_of(render.finish());
    }
};

TEST_F(MakeReference, NameAndSourceContainTheScenesVariables) {
    h.viewer.load("room.xml", scene_in("room.xml").loader, {"room.xml", {{"unit", "100000"}}, {}});
    h.wait_until([&] { return h.state().scene_info.shown == 2; });
    h.frames(2);
    EXPECT_EQ(file(h).filename().string().rfind("room-100000-", 0), 0u) << file(h);
    begin(h, 2);
    wait_for_end(h);
    const auto settings = nlohmann::json::parse(read_reference(file(h)).settings);
    EXPECT_EQ(settings.at("scene"), "room.xml");
    EXPECT_EQ(settings.at("variables").at("unit"), "100000");
}

TEST_F(MakeReference, IsOpenedAndEqualsThatOfTheCommand) {
    begin(h, 16);
    wait_for_end(h);
    h.wait_until([&] { return h.state().companions.reference != nullptr; });
    EXPECT_EQ(h.state().companions.reference->name, file(h).string());
    EXPECT_FALSE(h.state().reference_making.show);
    EXPECT_EQ(checksum_of(read_reference(file(h))), expected(h, 16));
    EXPECT_FALSE(fs::exists(reference_checkpoint(file(h))));
    EXPECT_NE(h.state().messages.front().text.find("Saved the reference, 16 spp, to " + file(h).string()),
              std::string::npos)
        << h.state().messages.front().text;
}

TEST_F(MakeReference, ContinuesAfterACancellation) {
    begin(h, 1 << 20);
    wait_for_samples(h, 4);
    h.wait_until([&] { return h.state().reference_making.progress->error.has_value(); });
    EXPECT_GT(h.state().reference_making.progress->error->relative_mse, 0);
    h.frames(2);
    h.save("reference-progress.png");
    EXPECT_TRUE(h.has("making"));
    EXPECT_FALSE(h.has("reference.make"));
    h.click("reference.cancel");
    wait_for_end(h);
    EXPECT_EQ(h.state().companions.reference, nullptr);
    ASSERT_TRUE(fs::exists(reference_checkpoint(file(h))));
    EXPECT_EQ(h.state().messages.back().kind, Message::Kind::note);
    const std::string text = h.state().messages.back().text;
    const int spp = std::stoi(text.substr(text.find(" at ") + 4));
    ASSERT_GE(spp, 4);

    h.frames(2);
    h.save("reference-form.png");
    ASSERT_TRUE(h.has("reference.anew"));
    h.state().reference_making.spp = spp + 6;
    h.click("reference.make");
    wait_for_end(h);
    EXPECT_EQ(checksum_of(read_reference(file(h))), expected(h, spp + 6));
}

TEST_F(MakeReference, AnewDropsTheCheckpoint) {
    begin(h, 1 << 20);
    wait_for_samples(h, 4);
    h.click("reference.cancel");
    wait_for_end(h);
    h.frames(2);
    h.click_at("reference.anew", 0.05f);
    EXPECT_TRUE(h.state().reference_making.anew);
    h.state().reference_making.spp = 2;
    h.click("reference.make");
    EXPECT_FALSE(h.state().reference_making.anew); // once only
    wait_for_end(h);
    EXPECT_EQ(checksum_of(read_reference(file(h))), expected(h, 2));
}

TEST_F(MakeReference, OfAnotherCameraHasAnotherName) {
    const fs::path before = file(h);
    h.state().camera.orbit({30, 10}, 300);
    const fs::path after = file(h);
    EXPECT_NE(before, after);
    h.wait_until([&] { return h.viewer.settled(2); });
    begin(h, 4);
    wait_for_end(h);
    EXPECT_EQ(checksum_of(read_reference(after)), expected(h, 4));
    h.state().camera.go_home();
    EXPECT_EQ(file(h), before);
}

TEST_F(MakeReference, OfAnOlderViewIsNotOpened) {
    begin(h, 32);
    ASSERT_TRUE(h.state().reference_making.is_making());
    const fs::path made = file(h);
    h.state().camera.orbit({30, 10}, 300);
    wait_for_end(h);
    h.frames(3);
    EXPECT_TRUE(fs::exists(made));
    EXPECT_EQ(h.state().companions.reference, nullptr);
    EXPECT_EQ(h.state().wishes.open_reference, "");
    EXPECT_NE(h.state().messages.back().text.find(made.string()), std::string::npos);
    EXPECT_NE(h.state().messages.back().text.find("not opened"), std::string::npos);
}

TEST_F(MakeReference, AnUnwritableFileGivesAMessage) {
    h.type(Key::m, true);
    std::strcpy(h.state().reference_making.file.data(), "/nowhere/reference.exr");
    h.click("reference.make");
    wait_for_end(h);
    EXPECT_EQ(h.state().messages.back().kind, Message::Kind::error);
    EXPECT_NE(h.state().messages.back().text.find("/nowhere/reference.exr"), std::string::npos);
}

TEST_F(MakeReference, TheDialogEstimatesTheTime) {
    ASSERT_TRUE(estimated_seconds(h.state()).has_value());
    const double seconds = *estimated_seconds(h.state());
    h.state().reference_making.spp *= 2;
    EXPECT_NEAR(*estimated_seconds(h.state()), 2 * seconds, 1e-6 * seconds);
    EXPECT_EQ(duration_text(45.2), "45 s");
    EXPECT_EQ(duration_text(12.4 * 60), "12 min");
    EXPECT_EQ(duration_text(3 * 3600 + 5 * 60), "3 h 5 min");
    std::strcpy(h.state().reference_making.file.data(), "mine");
    EXPECT_EQ(wanted_reference_file(h.state()), folder.path / "mine.exr");
    std::strcpy(h.state().reference_making.file.data(), "MINE.EXR");
    EXPECT_EQ(wanted_reference_file(h.state()), folder.path / "MINE.EXR");
    std::strcpy(h.state().reference_making.file.data(), "~/mine");
    EXPECT_EQ(wanted_reference_file(h.state()), fs::path(std::getenv("HOME")) / "mine.exr");
    h.type(Key::m, true);
    h.type(Key::escape);
    EXPECT_FALSE(h.state().reference_making.show);
}

TEST(MakeReferenceTwice, ClosingTheViewerKeepsTheCheckpoint) {
    const CurrentFolder folder;
    fs::path made;
    {
        ViewerHarness h;
        h.rest(2);
        MakeReference::begin(h, 1 << 20);
        MakeReference::wait_for_samples(h, 2);
        made = MakeReference::file(h);
    }
    EXPECT_TRUE(fs::exists(reference_checkpoint(made)));
    EXPECT_FALSE(fs::exists(made));
    ViewerHarness h;
    h.rest(2);
    MakeReference::begin(h, 1 << 20);
    MakeReference::wait_for_samples(h, 2);
    EXPECT_GT(h.state().reference_making.progress->spp_resumed, 0);
}

/// A closed viewer must not run on, hidden, until the end of a pass.
TEST(MakeReferenceTwice, ClosingTheViewerEndsThePassUnderWay) {
    const CurrentFolder folder;
    ReferenceRecipe recipe;
    PictureSubject subject;
    fs::path made;
    int spp = 0;
    {
        ViewerHarness h;
        h.rest(1);
        h.state().rendering.size.custom = {320, 240};
        for (PaneState& pane : h.state().panes)
            pane.settings.render.max_depth = 12;
        h.frames(2);
        recipe.size = h.state().request_size();
        ASSERT_EQ(recipe.size, glm::ivec2(320, 240));
        recipe.settings.max_depth = 12;
        subject = {h.state().scene_info.source, h.state().scene, h.state().camera.camera()};
        MakeReference::begin(h, 1 << 20);
        made = MakeReference::file(h);
        MakeReference::wait_for_samples(h, 1); // the next pass starts
        spp = h.state().reference_making.progress->spp;
    }
    ASSERT_TRUE(fs::exists(reference_checkpoint(made)));
    recipe.spp = 1 << 20;
    ThreadPool pool(1);
    EXPECT_EQ(ReferenceRender(made, subject, recipe, pool).spp_resumed(), spp);
}

} // namespace
} // namespace tessera::test
