// Preferences: the layout and the recent scenes that the viewer stores.

#include "tests/ui/viewer/current_folder.h"
#include "tests/ui/viewer_harness.h"
#include "ui/settings/preferences.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <utility>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

TEST(Preferences, AreReadAsWritten) {
    CurrentFolder folder;
    const fs::path file = folder.path / "deep" / "viewer.json";
    std::string note;
    EXPECT_TRUE(read_preferences(file, note) == Preferences{});
    EXPECT_EQ(note, "");
    Preferences p;
    p.window = {{1200, 700}, glm::ivec2(-40, 25), true};
    p.panes = 4;
    p.theme = Theme::light;
    p.text_factor = 1.5f;
    p.panel_width = 31;
    p.show_panel = false;
    p.show_statistics = p.show_charts = true;
    for (int i = 0; i < 12; ++i)
        p.add_recent("/scenes/" + std::to_string(i % 10) + ".xml");
    EXPECT_EQ(p.recent_scenes.size(), Preferences::most_recent);
    EXPECT_EQ(p.recent_scenes.front(), "/scenes/1.xml");
    write_preferences(file, p);
    EXPECT_TRUE(read_preferences(file, note) == p);
    EXPECT_EQ(note, "");
}

TEST(Preferences, ABrokenFileIsIgnoredWithANote) {
    CurrentFolder folder;
    for (const char* text : {"{", "[1]", "{\"window\": \"large\"}", "{\"recent_scenes\": 3}", "\xff\xfe"}) {
        std::ofstream("viewer.json") << text;
        std::string note;
        EXPECT_TRUE(read_preferences("viewer.json", note) == Preferences{}) << text;
        EXPECT_NE(note.find("viewer.json"), std::string::npos) << text;
    }
    // Values out of range are harmless.
    std::ofstream("viewer.json") << "{\"window\": [0, -5], \"text_factor\": 99, \"panes\": 9, \"panel_width\": 0}";
    std::string note;
    EXPECT_EQ(read_preferences("viewer.json", note).window.size, glm::ivec2(0));
    EXPECT_EQ(read_preferences("viewer.json", note).text_factor, 3.0f);
    EXPECT_EQ(read_preferences("viewer.json", note).panes, most_panes);
    EXPECT_EQ(read_preferences("viewer.json", note).panel_width, Layout::least_panel_width);
}

TEST(Preferences, AnUnreadableFileIsIgnoredWithANote) {
    CurrentFolder folder;
    fs::create_directory("folder");
    fs::create_symlink("nowhere", "link");
    for (const char* file : {"folder", "link"}) {
        std::string note;
        EXPECT_TRUE(read_preferences(file, note) == Preferences{}) << file;
        EXPECT_EQ(note.find(std::string(file) + " is ignored, as it cannot be read: "), 0u) << note;
    }
}

TEST(Preferences, AreWrittenToALinksTarget) {
    CurrentFolder folder;
    const fs::path file = folder.path / "viewer.json";
    Preferences p;
    std::ofstream("elsewhere.json") << "{}";
    fs::create_symlink("elsewhere.json", file);
    p.panes = 4;
    write_preferences(file, p);
    std::string note;
    EXPECT_TRUE(fs::is_symlink(file));
    EXPECT_EQ(read_preferences("elsewhere.json", note).panes, 4);
}

TEST(Preferences, FollowTheXdgSpecification) {
    const char* old = std::getenv("XDG_CONFIG_HOME");
    const std::string before = old ? old : "", home = std::getenv("HOME") ? std::getenv("HOME") : "/";
    ::setenv("XDG_CONFIG_HOME", "/somewhere", 1);
    EXPECT_EQ(preferences_file(), "/somewhere/tessera/viewer.json");
    ::setenv("XDG_CONFIG_HOME", "relative", 1);
    ::setenv("HOME", "/home/me", 1);
    EXPECT_EQ(preferences_file(), "/home/me/.config/tessera/viewer.json");
    old ? ::setenv("XDG_CONFIG_HOME", before.c_str(), 1) : ::unsetenv("XDG_CONFIG_HOME");
    ::setenv("HOME", home.c_str(), 1);
}

ViewerOptions remembering_in(const CurrentFolder& folder) {
    ViewerOptions options = ViewerHarness::two_panes();
    options.preferences = folder.path / "viewer.json";
    options.open = scene_in;
    return options;
}

TEST(Remembered, LayoutAndRecentScenes) {
    CurrentFolder folder;
    ViewerOptions options = remembering_in(folder);
    std::atomic<int> opened = 0;
    options.open = [&](const fs::path& file) {
        ++opened;
        return scene_in(file);
    };
    float width = 0;
    {
        ViewerHarness h({900, 600}, 1, options);
        h.viewer.drop({folder.path / "room.xml"});
        h.wait_until([&] { return h.state().scene_info.shown == 1; });
        h.type(Key::h);
        h.type(Key::f9);
        h.type(Key::digit4, true);
        h.drag(h.place("panel edge").center(), {-60, 0});
        EXPECT_GT(h.state().layout.panel_width, 22);
        width = h.place("panel edge").center().x;
    }
    options.uses_stored_pane_count = true;
    ViewerHarness h({900, 480}, 1, options);
    EXPECT_EQ(h.state().panes.size(), 4u);
    h.frames(2);
    EXPECT_EQ(h.place("panel edge").center().x, width);
    EXPECT_TRUE(h.state().layout.show_charts);
    EXPECT_EQ(h.state().layout.theme, Theme::light);
    ASSERT_EQ(h.state().scene_info.recent.size(), 1u);
    std::string note;
    EXPECT_EQ(read_preferences(options.preferences, note).window.size, glm::ivec2(900, 600));
    h.frames(3);
    h.click("menu File");
    h.click("menu File/recent 0");
    h.wait_until([&] { return h.state().scene_info.shown == 1; });
    EXPECT_EQ(opened, 2);
}

TEST(Remembered, ScenesOfTwoConcurrentViewersAreKept) {
    CurrentFolder folder;
    const ViewerOptions options = remembering_in(folder);
    ViewerHarness h({900, 600}, 1, options);
    h.frames(2);
    Preferences of_another;
    of_another.add_recent("/scenes/theirs.xml");
    write_preferences(options.preferences, of_another);
    h.viewer.drop({"/scenes/ours.xml"});
    h.wait_until([&] { return h.state().scene_info.shown == 1; });
    h.finish_saving();
    const std::vector<std::string> both{"/scenes/ours.xml", "/scenes/theirs.xml"};
    EXPECT_EQ(h.state().scene_info.recent, both);
    std::string note;
    EXPECT_EQ(read_preferences(options.preferences, note).recent_scenes, both);
}

TEST(Remembered, FramesDoNotWaitForTheDisk) {
    CurrentFolder folder;
    const ViewerOptions options = remembering_in(folder);
    ViewerHarness h({900, 600}, 1, options);
    std::promise<void> disk;
    h.viewer.saver().save([ready = disk.get_future().share()] {
        ready.wait();
        return std::string();
    });
    Preferences of_another;
    of_another.add_recent("/scenes/theirs.xml");
    write_preferences(options.preferences, of_another);
    std::vector<std::string> scenes{"/scenes/room.xml"};
    h.viewer.drop({scenes.front()}); // its preferences are stored
    h.wait_until([&] { return h.state().scene_info.shown == 1; });
    h.frames(3);
    std::string note;
    EXPECT_TRUE(read_preferences(options.preferences, note) ==
                of_another);                        // not written, although frames continue
    EXPECT_EQ(h.state().scene_info.recent, scenes); // nor read
    disk.set_value();
    h.finish_saving();
    scenes.emplace_back("/scenes/theirs.xml");
    EXPECT_EQ(h.state().scene_info.recent, scenes);
    EXPECT_EQ(read_preferences(options.preferences, note).recent_scenes, scenes);
}

/// Counts the messages that contain the text.
long count_messages(ViewerHarness& h, const std::string& words) {
    const auto& messages = h.state().messages;
    return std::count_if(messages.begin(), messages.end(),
                         [&](const Message& m) { return m.text.find(words) != std::string::npos; });
}

std::string first_line(const fs::path& file) {
    std::string line;
    std::getline(std::ifstream(file), line);
    return line;
}

TEST(Remembered, EachBrokenFileIsRenamed) {
    CurrentFolder folder;
    const ViewerOptions options = remembering_in(folder);
    const std::vector<std::pair<std::string, std::string>> broken{
        {"{\"theme\": light}", ".broken"}, {"[1]", ".broken-2"}, {"[2]", ".broken-3"}};
    for (const auto& [text, ending] : broken) {
        std::ofstream(options.preferences) << text;
        ViewerHarness h({900, 600}, 1, options);
        h.load_scene();
        EXPECT_EQ(count_messages(h, "it is renamed to " + options.preferences.string() + ending), 1)
            << h.state().messages.front().text;
    }
    for (const auto& [text, ending] : broken)
        EXPECT_EQ(first_line(options.preferences.string() + ending), text);
    std::string note;
    EXPECT_EQ(read_preferences(options.preferences, note).panes, 2);
    EXPECT_EQ(note, "");
}

TEST(Remembered, AFileBrokenDuringTheRunIsRenamed) {
    CurrentFolder folder;
    const ViewerOptions options = remembering_in(folder);
    std::ofstream(options.preferences) << R"({"recent_scenes": ["/a.xml"]})";
    ViewerHarness h({900, 600}, 1, options);
    std::ofstream(options.preferences) << "[1]";
    h.viewer.drop({"/scenes/room.xml"});
    h.wait_until([&] { return h.state().scene_info.shown == 1; });
    h.finish_saving();
    EXPECT_EQ(count_messages(h, "it is renamed to "), 1);
    EXPECT_EQ(first_line(options.preferences.string() + ".broken"), "[1]");
    std::string note;
    EXPECT_EQ(read_preferences(options.preferences, note).recent_scenes.size(), 2u);
}

/// Expects one message about an unreadable path in place of the preferences file, and no other file except
/// thumbnails, if a scene has rendered for long enough.
void expect_nothing_stored(const CurrentFolder& folder) {
    {
        ViewerHarness h({900, 600}, 1, remembering_in(folder));
        for (int n = 1; n <= 2; ++n) {
            h.viewer.drop({"/scenes/room.xml"});
            h.wait_until([&] { return h.state().scene_info.shown == n; });
            h.finish_saving();
        }
        EXPECT_EQ(count_messages(h, "cannot be read"), 1);
        EXPECT_EQ(h.state().scene_info.recent, std::vector<std::string>{"/scenes/room.xml"});
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.path))
        EXPECT_TRUE(entry.path().filename() == "viewer.json" || entry.path().filename() == "recent")
            << entry.path();
}

TEST(Remembered, AFolderInPlaceOfTheFileStays) {
    CurrentFolder folder;
    fs::create_directory("viewer.json");
    expect_nothing_stored(folder);
    EXPECT_TRUE(fs::is_directory("viewer.json"));
}

TEST(Remembered, ADanglingLinkStays) {
    CurrentFolder folder;
    fs::create_symlink("nowhere", "viewer.json");
    expect_nothing_stored(folder);
    EXPECT_TRUE(fs::is_symlink("viewer.json"));
}

TEST(Remembered, TheViewerRunsWithoutACurrentFolder) {
    CurrentFolder folder;
    const ViewerOptions options = remembering_in(folder);
    fs::create_directory("gone");
    fs::current_path("gone");
    fs::remove(folder.path / "gone");
    {
        ViewerHarness h({900, 600}, 1, options);
        h.viewer.drop({"room.xml"});
        h.wait_until([&] { return h.state().scene_info.shown == 1; });
        h.type(Key::p, true); // saves settings
        h.finish_saving();
        EXPECT_EQ(h.state().messages.back().kind, Message::Kind::error);
        h.type(Key::o, true);
        h.type(Key::escape);
    }
    std::string note;
    EXPECT_EQ(read_preferences(options.preferences, note).panes, 2);
    EXPECT_TRUE(read_preferences(options.preferences, note).recent_scenes.empty());
}

TEST(Remembered, PanesOfTheCommandLineAreNotStored) {
    CurrentFolder folder;
    ViewerOptions options = remembering_in(folder);
    std::string note;
    {
        ViewerHarness h({900, 600}, 1, options);
    }
    EXPECT_EQ(read_preferences(options.preferences, note).panes, 2);
    options.panes.resize(1); // -m gpr
    options.uses_stored_pane_count = false;
    {
        ViewerHarness h({900, 600}, 1, options);
        h.frames(2);
    }
    EXPECT_EQ(read_preferences(options.preferences, note).panes, 2);
    {
        ViewerHarness h({900, 600}, 1, options);
        h.state().set_pane_count(4); // as if the user had done so
        h.frames(2);
    }
    EXPECT_EQ(read_preferences(options.preferences, note).panes, 4);
}

TEST(Remembered, AMaximisedWindowKeepsItsNormalSize) {
    CurrentFolder folder;
    const ViewerOptions options = remembering_in(folder);
    {
        ViewerHarness h({900, 600}, 1, options);
        h.frames(2);
        h.state().layout.window.position = {30, 40};
        h.state().layout.window.maximised = true;
        h.resize({1280, 720});
        h.frames(2);
    }
    std::string note;
    EXPECT_EQ(read_preferences(options.preferences, note).window,
              (WindowPlace{{900, 600}, glm::ivec2(30, 40), true}));
}

} // namespace
} // namespace tessera::test
