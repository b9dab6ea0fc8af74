// The gallery of scenes, whose pictures are loaded in the background.
#include "tests/ui/viewer/current_folder.h"
#include "tests/ui/viewer_harness.h"
#include "ui/settings/preferences.h"
#include "ui/settings/thumbnails.h"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <thread>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

ViewerOptions with_gallery(std::atomic<bool>& may_end, std::filesystem::path& opened) {
    ViewerOptions options = ViewerHarness::two_panes();
    options.begins_with_gallery = true;
    options.gallery = [&] {
        while (!may_end)
            std::this_thread::yield();
        GalleryContents found;
        found.entries.push_back({"cornell-box", "built-in", "", false, {}, RgbImage(8, 6, Rgb(1))});
        found.entries.push_back(
            {"glossy", "fails: PR", "G-PR worse 1.2", true, "glossy.xml", RgbImage(8, 6, Rgb(1))});
        found.problem = "the other scenes are not there";
        return found;
    };
    options.open = [&](const std::filesystem::path& file) {
        opened = file.empty() ? "built-in" : file;
        return SceneOrigin{opened.string(), {}, [](SceneNotes&, LoadProgress&) { return viewer_scene(); }};
    };
    return options;
}

TEST(Gallery, OpensTheClickedScene) {
    std::atomic<bool> may_end = false;
    std::filesystem::path opened;
    ViewerHarness h({1280, 720}, 1, with_gallery(may_end, opened));
    h.frames(3); // frames do not wait for the gallery
    EXPECT_TRUE(h.has("gallery.close"));
    EXPECT_FALSE(h.has("gallery/glossy"));
    may_end = true;
    ASSERT_TRUE(h.wait_until([&] { return h.has("gallery/glossy"); }));
    h.frames(2);
    h.save("gallery");
    EXPECT_GT(h.brightness("gallery/glossy"), 120) << "its picture is white";
    h.click("gallery/glossy");
    ASSERT_TRUE(h.wait_until([&] { return h.state().scene_info.name == "glossy.xml"; }));
    EXPECT_FALSE(h.state().layout.show_gallery);
    h.type(Key::g, true);
    h.frames(2);
    h.click("gallery/cornell-box");
    ASSERT_TRUE(h.wait_until([&] { return h.state().scene_info.name == "built-in"; }));
    h.type(Key::g, true);
    h.type(Key::escape);
    EXPECT_FALSE(h.state().layout.show_gallery);
}

TEST(Gallery, RecentScenesHaveThumbnailsAfterARender) {
    const CurrentFolder folder;
    std::atomic<bool> may_end = true;
    std::filesystem::path opened;
    ViewerOptions options = with_gallery(may_end, opened);
    options.preferences = std::filesystem::absolute("viewer.json");
    options.begins_with_gallery = false;
    ViewerHarness h({1280, 720}, 1, options);
    const SceneOrigin origin = scene_in("rooms/room.xml");
    h.viewer.load("room.xml", origin.loader, origin.source);
    ASSERT_TRUE(h.wait_until([&] { return h.viewer.settled(16) && !h.viewer.saver().running(); }));
    const auto pictures = [] {
        std::size_t count = 0;
        std::error_code none;
        for (const auto& entry : std::filesystem::directory_iterator("recent", none))
            count += entry.path().extension() == ".png";
        return count;
    };
    EXPECT_EQ(pictures(), 1u);
    h.type(Key::g, true);
    ASSERT_TRUE(h.wait_until([&] { return h.has("gallery.recent0") && h.has("gallery/glossy"); }));
    h.frames(3);
    h.save("gallery-recent.png");
    EXPECT_TRUE(h.has("gallery.drop"));
    EXPECT_GT(h.brightness("gallery.recent0"), 40) << "without a thumbnail it is black";
    h.click("gallery.recent0");
    ASSERT_TRUE(h.wait_until([&] { return !h.state().layout.show_gallery; }));
    EXPECT_EQ(opened, std::filesystem::absolute("rooms/room.xml"));
}

TEST(Gallery, ThumbnailsOfOtherScenesAreRemoved) {
    const CurrentFolder folder;
    const std::filesystem::path preferences = std::filesystem::absolute("viewer.json");
    const RgbImage picture = thumbnail_of(RgbImage(300, 100, Rgb(0.5f)), 0);
    EXPECT_EQ(picture.width() * 3, picture.height() * 4);
    Preferences p;
    for (int i = 0; i < 12; ++i) {
        const std::string scene = "/scenes/" + std::to_string(i) + "/scene.xml";
        p.add_recent(scene);
        write_preferences(preferences, p);
        store_thumbnail(preferences, scene, picture);
    }
    EXPECT_TRUE(read_thumbnail(preferences, "/scenes/3/scene.xml").empty()) << "the scene is not recent";
    const RgbImage kept = read_thumbnail(preferences, "/scenes/11/scene.xml");
    ASSERT_EQ(kept.width(), picture.width());
    EXPECT_NEAR(kept(80, 60).r, picture(80, 60).r, 1.0f / 255);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator("recent"))
        files += entry.is_regular_file();
    EXPECT_EQ(files, Preferences::most_recent);
}

} // namespace

} // namespace tessera::test
