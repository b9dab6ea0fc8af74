// Settings files.

#include "render/io/files.h"
#include "render/io/text.h"
#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "tests/ui/viewer/current_folder.h"
#include "tests/ui/viewer_harness.h"
#include "ui/settings/settings_file.h"

#include <filesystem>
#include <fstream>
#include <utility>

#include <gtest/gtest.h>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

struct SettingsFile : testing::Test, ViewerHarness {
    CurrentFolder folder;
};

TEST_F(SettingsFile, RestoresAllSettings) {
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
    state().display.tone = {Tone::Curve::filmic, -2.5f, 1.75f};
    state().rendering.size = {SizeChoice::Base::custom, 0.5f, {80, 60}};
    state().rendering.pace = {Pace::Equal::spp, 12, 34.5};
    state().panes[3].settings.reconstruction.alpha = 0.5f;
    state().active_pane = 1;
    state().layout.alone = state().display.show_tiles = state().display.magnifier = state().layout.charts_by_spp =
        state().display.mark_negative = true;
    state().layout.chart_kind = ChartKind::shifts;
    state().layout.wipe = 0.125f;
    state().display.view = ImageView(3.5f, {0.25f, 0.75f});
    state().display.ranges = {{Buffer::depth, {0.5f, 7, false}}, {Buffer::error_squared, {1e-6f, 1e-2f, true}}};
    state().camera.orbit({30, 10}, 300);
    state().camera.dolly(0.5f);
    const auto camera = state().camera.camera();
    std::vector<PaneSettings> settings;
    for (const PaneState& pane : state().panes)
        settings.push_back(pane.settings);
    const std::string text = settings_json(state());

    ViewerState other;
    for (const PaneSettings& s : default_panes(1))
        other.panes.push_back({s, nullptr, 0, {}});
    other.camera.set_home(state().scene->camera(), state().scene->center(), state().scene->radius());
    apply_settings_json(other, text, "settings.json");
    ASSERT_EQ(other.panes.size(), 4u);
    EXPECT_TRUE(other.messages.empty()) << other.messages.front().text; // all fields are known
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_TRUE(other.panes[i].settings == settings[i]) << i;
    EXPECT_FALSE(other.linked);
    EXPECT_TRUE(other.display.tone == state().display.tone);
    EXPECT_TRUE(other.rendering.size == state().rendering.size);
    EXPECT_TRUE(other.rendering.pace == state().rendering.pace);
    EXPECT_TRUE(other.camera.camera() == camera);
    EXPECT_EQ(other.camera.distance(), state().camera.distance());
    EXPECT_EQ(other.active_pane, 1);
    EXPECT_TRUE(other.layout.alone && other.display.show_tiles && other.display.magnifier &&
                other.layout.charts_by_spp && other.display.mark_negative);
    EXPECT_EQ(other.layout.chart_kind, ChartKind::shifts);
    EXPECT_EQ(other.layout.wipe, 0.125f);
    EXPECT_TRUE(other.display.view == state().display.view);
    EXPECT_TRUE(other.display.ranges == state().display.ranges);
    other.scene_info.name = state().scene_info.name;
    EXPECT_EQ(settings_json(other), text);
}

TEST_F(SettingsFile, ACameraFileSetsCameraAndTargetDistance) {
    load_scene();
    const CameraControl home = state().camera;
    const std::string camera = camera_json(home.camera());
    state().camera.dolly(0.25f);
    apply_settings_json(state(), camera, "camera.json");
    EXPECT_TRUE(state().camera.camera() == home.camera());
    EXPECT_NEAR(state().camera.distance(), home.distance(), 1e-4f * home.distance());
}

TEST_F(SettingsFile, TheReferenceIsLoadedAgain) {
    state().companions.reference = std::make_shared<Reference>(Reference{"room.exr", {}, 1});
    const std::string text = settings_json(state());
    apply_settings_json(state(), text, "settings.json");
    EXPECT_EQ(state().wishes.open_reference, ""); // it is loaded already
    state().companions.reference.reset();
    apply_settings_json(state(), text, "settings.json");
    EXPECT_EQ(state().wishes.open_reference, "room.exr");
}

TEST_F(SettingsFile, ErrorsAreReportedAndChangeNothing) {
    const std::string before = settings_json(state());
    for (const char* text : {"",
                             "{",
                             "[]",
                             "{\"panes\": []}",
                             "{\"panes\": [{\"method\": \"xyz\"}]}",
                             "{\"panes\": [{\"settings\": {\"tile\": \"99\"}}]}",
                             "{\"panes\": [{\"settings\": {\"tile\": 4}}]}",
                             "{\"panes\": [{}], \"tone\": {\"exposure\": 1e9}}",
                             "{\"panes\": [{}], \"camera\": {\"fov\": 1}}",
                             "{\"panes\": [{}], \"size\": {\"base\": \"moon\"}}",
                             "{\"panes\": [{}], \"active\": 2}",
                             "{\"panes\": [{}], \"ranges\": {\"moon\": {}}}",
                             "{\"panes\": [{}], \"ranges\": {\"depth\": {\"low\": 3, \"high\": 2}}}",
                             "{\"panes\": [{}], \"ranges\": {\"depth\": {\"low\": 0, \"logarithmic\": true}}}",
                             "{\"panes\": [{\"alpha\": \"much\"}]}",
                             "{\"panes\": [{\"alpha\": true}]}",
                             "{\"panes\": [{\"seed\": -1}]}",
                             "{\"panes\": [{\"seed\": 1e300}]}",
                             "{\"panes\": [{\"seed\": 1.5}]}",
                             "{\"panes\": [{\"seed\": true}]}",
                             "{\"panes\": [{\"seed\": 99999999999999999999}]}"}) {
        try {
            apply_settings_json(state(), text, "bad.json");
            ADD_FAILURE() << text;
        } catch (const LoadError& error) {
            EXPECT_EQ(std::string(error.what()).find("bad.json:1:"), 0u) << error.what();
        }
        EXPECT_EQ(settings_json(state()), before) << text;
    }
}

TEST_F(SettingsFile, OldNamesOfBuffersAreRead) {
    apply_settings_json(state(),
                        "{\"panes\": [{\"buffer\": \"failed\"}],"
                        " \"ranges\": {\"failed\": {\"low\": 0, \"high\": 2}}}",
                        "old.json");
    EXPECT_EQ(pane(0).settings.buffer, Buffer::outcomes);
    ASSERT_EQ(state().display.ranges.count(Buffer::outcomes), 1u);
    EXPECT_EQ(state().display.ranges.at(Buffer::outcomes).high, 2);
    EXPECT_TRUE(state().messages.empty());
}

TEST_F(SettingsFile, UnknownFieldsAreReported) {
    apply_settings_json(
        state(), "{\"panes\": [{},\n {\"tile\": 8, \"settings\": {\"tile\": \"4\"}}],\n \"tome\": {\"x\": 1}}",
        "odd.json");
    EXPECT_EQ(state().panes[1].settings.render.tile, 4);
    ASSERT_EQ(state().messages.size(), 2u);
    EXPECT_EQ(state().messages[0].text, "odd.json:3:10: the unknown field \"tome\" is ignored");
    EXPECT_EQ(state().messages[1].text, "odd.json:2:11: the unknown field \"tile\" is ignored");
    EXPECT_EQ(state().messages[0].kind, Message::Kind::note);
}

TEST_F(SettingsFile, MessagesHaveLineAndColumn) {
    const std::pair<const char*, const char*> cases[] = {
        {"{\"panes\": [{}],\n \"tone\": {\n  \"exposure\": 99}}", "bad.json:3:15: exposure is out of range"},
        {"{\"panes\": [{}, {\n\"settings\": {\"tile\": 4}}]}", "bad.json:2:22: tile has the wrong type: number"},
        {"{\"panes\": [{}, {\n\"settings\": {\"tile\": \"99\"}}]}", "bad.json:2:22: "},
        {"{\"panes\": [{\n \"alpha\": 0}]}", "bad.json:2:11: alpha is out of range"},
        {"{\"panes\": [{\n \"norm\": \"l3\"}]}", "bad.json:2:10: norm is \"l3\": must be one of none, l2, l1, "
                                                 "mixed, uniform, weighted, guided, smoothed, oidn"},
        {"{\"panes\": [{}],\n \"pace\": {\"spp_limit\": -1}}", "bad.json:2:24: spp_limit is out of range"},
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

TEST_F(SettingsFile, IsSavedByItsActionAndLoadedByDropping) {
    load_scene();
    state().panes[0].settings.render.tile = 3;
    type(Key::p, true);
    finish_saving();
    fs::path file;
    for (const auto& entry : fs::directory_iterator(folder.path))
        file = entry.path();
    ASSERT_EQ(file.extension(), ".json");
    state().panes[0].settings.render.tile = 8;
    viewer.drop({file});
    frame();
    EXPECT_EQ(state().panes[0].settings.render.tile, 3);
    viewer.drop({folder.path / "none.json"});
    frame();
    EXPECT_EQ(state().messages.back().kind, Message::Kind::error);
}

TEST(DroppedTogether, SettingsApplyAfterTheScene) {
    CurrentFolder folder;
    ViewerOptions options = ViewerHarness::two_panes();
    options.open = scene_in;
    ViewerHarness h({900, 600}, 1, options);
    h.load_scene();
    for (PaneState& pane : h.state().panes)
        pane.settings.render.max_depth = 3;
    h.state().camera.orbit({40, 10}, 300);
    h.state().display.view = ImageView(2, {0.25f, 0.5f});
    const Camera camera = h.state().camera.camera();
    write_text(folder.path / "s.json", settings_json(h.state()));
    h.state().camera.go_home();
    for (PaneState& pane : h.state().panes)
        pane.settings.render.max_depth = 9;

    const int before = h.state().scene_info.shown;
    h.viewer.drop({folder.path / "s.json", folder.path / "other.xml"});
    h.wait_until([&] { return h.state().scene_info.shown > before && h.state().wishes.open_settings.empty(); });
    EXPECT_TRUE(h.state().camera.camera() == camera);
    EXPECT_EQ(h.state().display.view.zoom(), 2);
    for (const PaneState& pane : h.state().panes)
        EXPECT_EQ(pane.settings.render.max_depth, 3);
}

} // namespace
} // namespace tessera::test
