// The file dialog and its list.

#include "render/io/exr.h"
#include "tests/ui/viewer/current_folder.h"
#include "tests/ui/viewer_harness.h"
#include "ui/settings/settings_file.h"
#include "ui/state/file_names.h"

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

struct FileList : testing::Test {
    FileList() {
        for (const char* name : {"kitchen", "Kiosk", ".hidden", "kites"})
            fs::create_directory(name);
        for (const char* file : {"kiln.xml", "b.XML", "c.exr", ".dot.xml"})
            std::ofstream(file) << "";
    }
    static std::vector<std::string> names(const std::vector<FileEntry>& entries) {
        std::vector<std::string> result;
        for (const FileEntry& entry : entries)
            result.push_back(entry.name + (entry.is_folder ? "/" : ""));
        return result;
    }
    std::vector<FileEntry> all() {
        std::string error;
        std::vector<FileEntry> entries = list_folder(folder.path, ".xml", error);
        EXPECT_EQ(error, "");
        return entries;
    }
    using Names = std::vector<std::string>;
    CurrentFolder folder;
};

TEST_F(FileList, HasFoldersAndFilesWithTheExtension) {
    EXPECT_EQ(names(all()), (Names{".hidden/", "Kiosk/", "kitchen/", "kites/", ".dot.xml", "b.XML", "kiln.xml"}));
    EXPECT_EQ(names(beginning_with(all(), "")), (Names{"Kiosk/", "kitchen/", "kites/", "b.XML", "kiln.xml"}));
    EXPECT_EQ(names(beginning_with(all(), "KI")), (Names{"Kiosk/", "kitchen/", "kites/", "kiln.xml"}));
    EXPECT_EQ(names(beginning_with(all(), ".")), (Names{".hidden/", ".dot.xml"}));
    std::string error;
    EXPECT_TRUE(list_folder(folder.path / "none", ".xml", error).empty());
    EXPECT_NE(error.find("none"), std::string::npos);
}

TEST_F(FileList, CompletesTheCommonPrefix) {
    EXPECT_EQ(common_beginning(beginning_with(all(), "kit")), "kit");
    EXPECT_EQ(common_beginning(beginning_with(all(), "kitc")), "kitchen/");
    EXPECT_EQ(common_beginning(beginning_with(all(), "kil")), "kiln.xml");
    EXPECT_EQ(common_beginning({}), "");
}

TEST_F(FileList, ReadsTypedPaths) {
    EXPECT_EQ(typed_path("kit").folder, folder.path);
    EXPECT_EQ(typed_path("kit").beginning, "kit");
    EXPECT_EQ(typed_path("kitchen/").folder.lexically_relative(folder.path), "kitchen/");
    EXPECT_EQ(typed_path("kitchen/../a").folder, folder.path / "");
    EXPECT_EQ(typed_path("/a").folder, "/");
    EXPECT_EQ(typed_path("/a").beginning, "a");
    EXPECT_EQ(typed_path("~/x/y").folder, fs::path(std::getenv("HOME")) / "x/");
}

struct Dialog : testing::Test {
    Dialog() {
        fs::create_directory("scenes");
        std::ofstream("scenes/room.xml") << "";
        options.open = [this](const fs::path& file) -> SceneOrigin {
            opened.push_back(file.string());
            return scene_in(file);
        };
    }
    CurrentFolder folder;
    std::vector<std::string> opened;
    ViewerOptions options = ViewerHarness::two_panes();
};

TEST_F(Dialog, OpensASceneByClicks) {
    ViewerHarness h({1280, 720}, 1, options);
    h.rest(2);
    h.type(Key::o, true);
    h.frames(2);
    EXPECT_TRUE(h.has("file.path"));
    h.click_at("file/scenes", 0.1f);
    h.frames(2);
    h.save("file-dialog.png");
    EXPECT_FALSE(h.has("file/scenes"));
    h.click_at("file/room.xml", 0.1f);
    EXPECT_TRUE(h.has("file/room.xml"));
    h.click("file.open");
    EXPECT_FALSE(h.state().layout.choosing.has_value());
    h.wait_until([&] { return h.state().scene_info.shown == 2; });
    EXPECT_EQ(opened, std::vector<std::string>{(folder.path / "scenes" / "room.xml").string()});
    h.frames(3);
    EXPECT_FALSE(h.has("file.path"));
    h.type(Key::o, true); // it begins in the scene's folder
    h.frames(2);
    EXPECT_TRUE(h.has("file/room.xml"));
    h.type(Key::escape);
    h.frames(2);
    EXPECT_FALSE(h.has("file.path"));
}

TEST_F(Dialog, LoadsSettingsAndReportsBrokenFiles) {
    ViewerHarness h({1280, 720}, 1, options);
    h.rest(2);
    h.state().panes[0].settings.render.tile = 3;
    std::ofstream("good.json") << settings_json(h.state());
    std::ofstream("bad.json") << "{\"panes\": [{\"method\": \"pt\"},\n  {\"method\": \"xyz\"}]}";
    h.state().panes[0].settings.render.tile = 8;
    const auto load = [&](const char* file) {
        h.click("menu File");
        h.click("menu File/Load settings ...");
        h.frames(2);
        h.click_at(std::string("file/") + file, 0.1f);
        h.click("file.open");
        h.frames(2);
    };
    load("bad.json");
    EXPECT_EQ(h.state().messages.back().kind, Message::Kind::error);
    EXPECT_NE(
        h.state().messages.back().text.find("bad.json:2:14: method is \"xyz\": must be one of pt, pr, gpt, gpr"),
        std::string::npos)
        << h.state().messages.back().text;
    EXPECT_EQ(h.pane(0).settings.render.tile, 8);
    h.state().layout.show_messages = false;
    load("good.json");
    EXPECT_EQ(h.pane(0).settings.render.tile, 3);
}

TEST_F(Dialog, BlocksOtherShortcuts) {
    std::ofstream("scenes/other.xml") << "";
    ViewerHarness h({1280, 720}, 1, options);
    h.rest(2);
    const Camera camera = h.state().camera.camera();
    h.type(Key::o, true);
    h.frames(2);
    h.click_at("file/scenes", 0.1f); // sets the focus
    h.viewer.keyboard().press(Key::w, Key::w, false, false);
    h.viewer.keyboard().press(Key::b, Key::b, false, false);
    h.frames(3);
    EXPECT_FALSE(h.state().layout.flicker);
    h.viewer.keyboard().release(Key::w);
    h.viewer.keyboard().release(Key::b);
    h.type(Key::digit4, true);
    h.type(Key::space);
    h.type(Key::f9);
    EXPECT_TRUE(h.state().camera.camera() == camera);
    EXPECT_EQ(h.state().panes.size(), 2u);
    EXPECT_FALSE(h.state().rendering.paused);
    EXPECT_EQ(h.state().layout.theme, Theme::dark);
    ASSERT_TRUE(h.has("file/other.xml"));
    ImGui::GetIO().AddInputCharacter('r'); // typed text is appended to the folder
    h.frames(3);
    EXPECT_TRUE(h.has("file/room.xml"));
    EXPECT_FALSE(h.has("file/other.xml"));
    h.type(Key::q, true); // except the shortcut that quits
    h.frames(2);
    EXPECT_TRUE(h.state().wishes.quit);
    h.type(Key::escape);
    h.frames(2);
    EXPECT_FALSE(h.state().layout.choosing.has_value());
}

TEST_F(Dialog, AReferenceHasAnAbsoluteName) {
    write_exr("r.exr", {{{"", RgbImage(48, 36, Rgb(1))}}, {}});
    ViewerHarness h({1280, 720}, 1, options);
    h.rest(2);
    h.state().wishes.open_reference = "./r.exr";
    h.wait_until([&] { return h.state().companions.reference != nullptr; });
    EXPECT_EQ(h.state().companions.reference->name, (folder.path / "r.exr").string());
    EXPECT_EQ(h.state().messages.back().text,
              "Loaded the reference r.exr"); // shown relative to the current folder
    EXPECT_EQ(short_path((folder.path / "a" / "r.exr").string()), "a/r.exr");
    EXPECT_EQ(short_path("/elsewhere/r.exr"), "/elsewhere/r.exr");
    EXPECT_EQ(short_path(folder.path.string() + "-2/r.exr"), folder.path.string() + "-2/r.exr");
}

TEST_F(Dialog, OpensAReferenceAndCanBeCancelled) {
    write_exr("r.exr", {{{"", RgbImage(48, 36, Rgb(1))}}, {}});
    ViewerHarness h({1280, 720}, 1, options);
    h.rest(2);
    h.type(Key::r, true);
    h.frames(2);
    h.click_at("file/r.exr", 0.1f);
    h.click("file.cancel");
    h.frames(2);
    EXPECT_EQ(h.state().companions.reference, nullptr);
    h.type(Key::r, true);
    h.frames(2);
    h.click("file.open"); // no file is chosen
    EXPECT_TRUE(h.state().layout.choosing.has_value());
    h.click_at("file/r.exr", 0.1f);
    h.click("file.open");
    h.wait_until([&] { return h.state().companions.reference != nullptr; });
}

/// Dear ImGui 1.86 fails if a window first appears after a modal one in a frame, so the dialog is drawn last.
TEST_F(Dialog, ASceneCanLoadBehindIt) {
    ViewerHarness h({1280, 720}, 1, options);
    h.rest(2);
    std::atomic<bool> through = false;
    h.viewer.load("a room", [&through](SceneNotes&, LoadProgress&) {
        while (!through)
            std::this_thread::yield();
        return viewer_scene();
    });
    h.state().layout.choosing = FilePurpose::scene;
    h.frames(3);
    EXPECT_TRUE(h.state().layout.choosing);
    through = true;
    h.wait_until([&] { return h.state().scene_info.loading.empty(); });
}

} // namespace
} // namespace tessera::test
