// The gallery of scenes: pictures to be clicked, made in the background.
#include "tests/ui/viewer_harness.h"

#include <atomic>
#include <filesystem>
#include <memory>
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

TEST(Gallery, OpensWhatIsClicked) {
    std::atomic<bool> may_end = false;
    std::filesystem::path opened;
    ViewerHarness h({1280, 720}, 1, with_gallery(may_end, opened));
    h.frames(3); // which do not wait for it
    EXPECT_TRUE(h.has("gallery.close"));
    EXPECT_FALSE(h.has("gallery/glossy"));
    may_end = true;
    ASSERT_TRUE(h.wait_until([&] { return h.has("gallery/glossy"); }));
    h.frames(2);
    h.save("gallery");
    EXPECT_GT(h.brightness("gallery/glossy"), 120) << "its picture is white";
    h.click("gallery/glossy");
    ASSERT_TRUE(h.wait_until([&] { return h.state().scene_name == "glossy.xml"; }));
    EXPECT_FALSE(h.state().layout.show_gallery);
    h.type(Key::g, true);
    h.frames(2);
    h.click("gallery/cornell-box");
    ASSERT_TRUE(h.wait_until([&] { return h.state().scene_name == "built-in"; }));
    h.type(Key::g, true);
    h.type(Key::escape);
    EXPECT_FALSE(h.state().layout.show_gallery);
}

} // namespace

} // namespace tessera::test
