// What the viewer saves, and what it remembers.

#include "render/load/messages.h"
#include "tests/ui/current_folder.h"
#include "tests/ui/viewer_harness.h"
#include "ui/preferences.h"
#include "ui/settings_file.h"

#include <atomic>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

struct SettingsFile : testing::Test, ViewerHarness {
    CurrentFolder folder;
};

TEST_F(SettingsFile, ComesBackAsItWas) {
    load_scene();
    state().linked = false;
    state().set_pane_count(4);
    state().panes[2].settings.render.tile = 9;
    state().panes[2].settings.render.method = Method::pr;
    state().panes[2].settings.render.pattern = Pattern::rooks;
    state().panes[2].settings.reconstruction.norm = Norm::l1;
    state().panes[1].settings.buffer = Buffer::dx_variance;
    state().panes[1].settings.comparison = {Comparison::Kind::difference, 3};
    state().panes[1].settings.render.seed = 0xffffffffffffull;
    state().tone = {Tone::Curve::filmic, -2.5f, 1.75f};
    state().size = {SizeChoice::Base::custom, 0.5f, {80, 60}};
    state().pace = {Pace::Equal::spp, 12, 34.5};
    state().camera.orbit({30, 10}, 300);
    const auto camera = state().camera.camera();
    std::vector<PaneSettings> settings;
    for (const PaneState& pane : state().panes)
        settings.push_back(pane.settings);
    const std::string text = settings_json(state());

    ViewerState other;
    for (const PaneSettings& s : default_panes(1))
        other.panes.push_back({s, nullptr, 0, {}});
    apply_settings_json(other, text, "settings.json");
    ASSERT_EQ(other.panes.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_TRUE(other.panes[i].settings == settings[i]) << i;
    EXPECT_FALSE(other.linked);
    EXPECT_TRUE(other.tone == state().tone);
    EXPECT_TRUE(other.size == state().size);
    EXPECT_TRUE(other.pace == state().pace);
    EXPECT_TRUE(other.camera.camera() == camera);
    EXPECT_EQ(settings_json(other).substr(0, 400), text.substr(0, 400));
}

TEST_F(SettingsFile, WhatIsBrokenChangesNothingAndIsNamed) {
    const std::string before = settings_json(state());
    for (const char* text :
         {"", "{", "[]", "{\"panes\": []}", "{\"panes\": [{\"method\": \"xyz\"}]}",
          "{\"panes\": [{\"settings\": {\"tile\": \"99\"}}]}", "{\"panes\": [{\"settings\": {\"tile\": 4}}]}",
          "{\"panes\": [{}], \"tone\": {\"exposure\": 1e9}}", "{\"panes\": [{}], \"camera\": {\"fov\": 1}}",
          "{\"panes\": [{}], \"size\": {\"base\": \"moon\"}}", "{\"panes\": [{\"alpha\": \"much\"}]}"}) {
        try {
            apply_settings_json(state(), text, "bad.json");
            ADD_FAILURE() << text;
        } catch (const LoadError& error) {
            EXPECT_EQ(std::string(error.what()).find("bad.json:1:"), 0u) << error.what();
        }
        EXPECT_EQ(settings_json(state()), before) << text;
    }
}

TEST_F(SettingsFile, MessagesHaveLineAndColumn) {
    const std::pair<const char*, const char*> cases[] = {
        {"{\"panes\": [{}],\n \"tone\": {\n  \"exposure\": 99}}", "bad.json:3:15: exposure is out of range"},
        {"{\"panes\": [{}, {\n\"settings\": {\"tile\": 4}}]}", "bad.json:2:22: tile is of the wrong kind: number"},
        {"{\"panes\": [{}, {\n\"settings\": {\"tile\": \"99\"}}]}", "bad.json:2:22: "},
        {"{\"panes\": [{},\n 3]}", "bad.json:2:2: this must be an object"},
        {"{\"panes\": [{}],\n \"camera\": {\"fov\": 1}}", "bad.json:2:12: the camera has no 'to_world'"},
        {"{\"panes\": [{}],\n}", "bad.json:2:1: the JSON is broken"},
    };
    for (const auto& [text, expected] : cases) {
        try {
            apply_settings_json(state(), text, "bad.json");
            ADD_FAILURE() << text;
        } catch (const LoadError& error) {
            EXPECT_EQ(std::string(error.what()).find(expected), 0u) << error.what();
        }
    }
}

TEST_F(SettingsFile, IsSavedByItsActionAndTakenByDropping) {
    load_scene();
    state().panes[0].settings.render.tile = 3;
    type(Key::p, true);
    fs::path file;
    for (const auto& entry : fs::directory_iterator(folder.path))
        file = entry.path();
    ASSERT_EQ(file.extension(), ".json");
    state().panes[0].settings.render.tile = 8;
    viewer.drop({file});
    EXPECT_EQ(state().panes[0].settings.render.tile, 3);
    viewer.drop({folder.path / "none.json"});
    EXPECT_EQ(state().messages.back().kind, Message::Kind::error);
}

TEST(Preferences, AreReadAsTheyWereWritten) {
    CurrentFolder folder;
    const fs::path file = folder.path / "deep" / "viewer.json";
    std::string note;
    EXPECT_TRUE(read_preferences(file, note) == Preferences{});
    EXPECT_EQ(note, "");
    Preferences p{{1200, 700}, Theme::light, 1.5f, false, true, true, {}};
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
    std::ofstream("viewer.json") << "{\"window\": [0, -5], \"ui_scale\": 99}"; // odd numbers do no harm
    std::string note;
    EXPECT_EQ(read_preferences("viewer.json", note).window_size, glm::ivec2(0));
    EXPECT_EQ(read_preferences("viewer.json", note).ui_scale, 3.0f);
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

TEST(Remembered, LayoutAndRecentScenes) {
    CurrentFolder folder;
    ViewerOptions options = ViewerHarness::two_panes();
    options.preferences = folder.path / "viewer.json";
    std::atomic<int> opened = 0;
    options.open = [&](const fs::path&) -> SceneLoader {
        ++opened;
        return [](std::vector<std::string>&, LoadProgress&) { return viewer_scene(); };
    };
    {
        ViewerHarness h({900, 600}, 1, options);
        h.viewer.drop({folder.path / "room.xml"});
        h.wait_until([&] { return h.state().scenes_shown == 1; });
        h.type(Key::h);
        h.type(Key::f9);
    }
    ViewerHarness h({640, 480}, 1, options);
    EXPECT_TRUE(h.state().show_charts);
    EXPECT_EQ(h.state().theme, Theme::light);
    ASSERT_EQ(h.state().recent_scenes.size(), 1u);
    std::string note;
    EXPECT_EQ(read_preferences(options.preferences, note).window_size, glm::ivec2(900, 600));
    h.frames(3);
    h.click("menu File");
    h.click("menu File/recent 0");
    h.wait_until([&] { return h.state().scenes_shown == 1; });
    EXPECT_EQ(opened, 2);
}

TEST(SavedAsExr, TheWriterGetsTheActivePane) {
    CurrentFolder folder;
    ViewerOptions options = ViewerHarness::two_panes();
    std::atomic<int> calls = 0;
    options.write_exr = [&](const fs::path& file, const fs::path&, const Snapshot& snapshot,
                            const ReconstructionSettings&) {
        EXPECT_EQ(file.extension(), ".exr");
        EXPECT_EQ(snapshot.settings.method, Method::gpr);
        if (++calls == 2)
            throw std::runtime_error("the disk is full");
    };
    ViewerHarness h({900, 600}, 1, options);
    h.rest(2);
    h.type(Key::e, true);
    h.wait_until([&] { return !h.state().messages.empty(); });
    EXPECT_EQ(h.state().messages.back().text.find("Saved "), 0u);
    h.type(Key::e, true);
    h.wait_until([&] { return h.state().messages.back().kind == Message::Kind::error; });
    EXPECT_EQ(h.state().messages.back().text, "the disk is full");
}

} // namespace
} // namespace tessera::test
