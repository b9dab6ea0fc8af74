// Saving and copying the camera.

#include "render/load/mitsuba_xml.h"
#include "render/scene/camera.h"
#include "tests/load/temporary_folder.h"
#include "tests/ui/viewer_harness.h"
#include "ui/state/camera_control.h"

#include <gtest/gtest.h>
#include <imgui.h>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

/// A viewer with a scene from another folder, and a moved camera.
struct CameraActions : testing::Test, ViewerHarness {
    CameraActions() {
        show(folder.path() / "room.xml");
        state().camera.orbit({37, 11}, 100);
        fs::current_path(elsewhere.path());
    }
    ~CameraActions() override { fs::current_path(before); }
    void show(const fs::path& file) {
        viewer.load("a room", scene_in(file).loader, scene_in(file).source);
        wait_until([&] { return !viewer.loading(); });
        frames(2);
    }
    std::string newest() { return state().messages.empty() ? "" : state().messages.back().text; }

    fs::path before = fs::current_path();
    TemporaryFolder folder, elsewhere;
};

TEST_F(CameraActions, SavesInTheCurrentFolderWithoutOverwriting) {
    type(Key::k);
    finish_saving();
    const fs::path file = elsewhere.path() / "room-camera.json";
    EXPECT_FALSE(fs::exists(folder.path() / "room-camera.json")) << "the scene's folder is not used";
    EXPECT_TRUE(read_camera(file) == state().camera.camera());
    EXPECT_NE(newest().find(file.string()), std::string::npos) << newest();
    EXPECT_EQ(state().messages.back().kind, Message::Kind::note);
    const Camera first = state().camera.camera();
    state().camera.dolly(0.5f);
    type(Key::k);
    finish_saving();
    EXPECT_TRUE(read_camera(file) == first);
    EXPECT_TRUE(read_camera(elsewhere.path() / "room-camera-2.json") == state().camera.camera());
    EXPECT_FALSE(state().wishes.saves.has(SaveKind::camera));
}

TEST_F(CameraActions, SavesInTheCurrentFolderWithoutASceneFile) {
    show({});
    type(Key::k);
    finish_saving();
    EXPECT_TRUE(read_camera(elsewhere.path() / "tessera-camera.json") == state().camera.camera());
}

TEST_F(CameraActions, ReportWhySavingFails) {
    const fs::path gone = fs::current_path() / "gone";
    fs::create_directory(gone);
    fs::current_path(gone);
    fs::remove(gone);
    type(Key::k);
    finish_saving();
    ASSERT_FALSE(state().messages.empty());
    EXPECT_EQ(state().messages.back().kind, Message::Kind::error);
    fs::current_path(elsewhere.path());
}

TEST_F(CameraActions, CopiesXmlForASensor) {
    click("menu Camera");
    click("menu Camera/Copy camera as XML");
    const std::string xml = ImGui::GetClipboardText();
    const LoadedScene loaded = parse_mitsuba_xml(
        "<scene version='3.0.0'><sensor type='perspective'>" + xml + "</sensor></scene>", "pasted.xml");
    EXPECT_TRUE(loaded.notes.empty());
    Camera pasted = loaded.description.camera;
    pasted.filter = state().camera.camera().filter; // the XML has no film
    EXPECT_TRUE(pasted == state().camera.camera());
    EXPECT_NE(newest().find("clipboard"), std::string::npos) << newest();
}

TEST(CameraActionsWithoutAScene, DoNothing) {
    ViewerHarness h;
    h.frames(2);
    h.type(Key::k);
    h.type(Key::k, false, true);
    h.type(Key::f5);
    EXPECT_TRUE(h.state().messages.empty());
    EXPECT_FALSE(h.viewer.loading());
}

} // namespace
} // namespace tessera::test
