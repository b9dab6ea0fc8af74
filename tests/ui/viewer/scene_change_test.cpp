// Reloading and dropping scenes, with their messages.

#include "render/scene/scene.h"
#include "tests/ui/viewer_harness.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

/// A scene file that changes between loads.
struct SceneFile {
    glm::vec3 eye{0, 0, 3.4f};
    SceneNotes notes;
    std::string error; ///< not empty: the file is broken
    int loads = 0;

    SceneLoader loader() {
        return [this](SceneNotes& told, LoadProgress&) -> std::shared_ptr<const Scene> {
            ++loads;
            told = notes;
            if (!error.empty())
                throw std::runtime_error(error);
            SceneDescription description = viewer_scene()->description();
            description.camera.to_world[3] = glm::vec4(eye, 1);
            return std::make_shared<const Scene>(std::move(description));
        };
    }
};

struct SceneChange : testing::Test, ViewerHarness {
    SceneChange() : ViewerHarness({1280, 720}, 1, options()) {}

    ViewerOptions options() {
        ViewerOptions result = two_panes();
        result.max_depth = {};
        result.open = [this](const std::filesystem::path& path) -> SceneOrigin {
            opened = path;
            return {path.string(), {path, {}, {}}, file.loader()};
        };
        return result;
    }
    void settle() {
        wait_until([&] { return !viewer.loading(); });
        frames(3);
    }
    void show() {
        viewer.load("room.xml", file.loader(), {"room.xml", {}, {}});
        settle();
    }
    void reload() {
        type(Key::f5);
        settle();
    }
    bool says(const std::string& text) {
        return std::any_of(state().messages.begin(), state().messages.end(),
                           [&](const Message& m) { return m.text.find(text) != std::string::npos; });
    }

    SceneFile file;
    std::filesystem::path opened;
};

TEST_F(SceneChange, ReloadKeepsCameraAndSettings) {
    show();
    const auto before = state().scene;
    state().camera.orbit({30, 10}, 100);
    state().panes[0].settings.render.tile = 3;
    state().panes[1].settings.render.max_depth = 7;
    state().display.tone.exposure = 1.5f;
    state().display.view.zoom_at({10, 10}, 2, {100, 100}, {100, 100});
    const Camera moved = state().camera.camera();
    const ImageView view = state().display.view;
    const std::uint64_t generation = pane(1).generation;
    reload();
    EXPECT_EQ(file.loads, 2);
    EXPECT_EQ(state().scene_info.shown, 2);
    EXPECT_NE(state().scene, before);
    EXPECT_GT(pane(1).generation, generation);
    EXPECT_TRUE(state().camera.camera() == moved);
    EXPECT_EQ(state().display.view, view);
    EXPECT_EQ(pane(0).settings.render.tile, 3);
    EXPECT_EQ(pane(1).settings.render.max_depth, 7);
    EXPECT_EQ(state().display.tone.exposure, 1.5f);
    EXPECT_EQ(state().scene_info.name, "room.xml");
    EXPECT_TRUE(state().history.can_undo()) << "the history is kept";
}

TEST_F(SceneChange, AnotherSceneClearsTheHistory) {
    show();
    state().display.tone.exposure = 1.5f;
    frames(3);
    EXPECT_TRUE(state().history.can_undo());
    viewer.load("other.xml", file.loader(), {"other.xml", {}, {}});
    settle();
    EXPECT_FALSE(state().history.can_undo());
}

TEST_F(SceneChange, ReloadSetsTheFilesCameraIfItHasChanged) {
    show();
    state().camera.orbit({30, 10}, 100);
    file.eye = {0, 0, 3};
    reload();
    EXPECT_TRUE(state().camera.camera() == state().scene->camera());
    EXPECT_EQ(state().camera.position(), glm::vec3(0, 0, 3));
}

TEST_F(SceneChange, ABrokenFileKeepsTheOldSceneAndReportsThePosition) {
    show();
    const auto before = state().scene;
    file.error = "room.xml:7:3: no such thing\n    <thing/>\n    ^";
    for (int i = 0; i < 3; ++i)
        reload();
    EXPECT_EQ(state().scene, before);
    ASSERT_EQ(state().messages.size(), 1u) << "the same error is listed once";
    EXPECT_EQ(state().messages[0].text, file.error);
    EXPECT_EQ(state().messages[0].kind, Message::Kind::error);
    EXPECT_TRUE(state().layout.show_messages);
    save("broken.png");
    file.error.clear();
    reload();
    EXPECT_NE(state().scene, before);
    EXPECT_TRUE(state().messages.empty());
    EXPECT_FALSE(state().layout.show_messages);
}

TEST_F(SceneChange, ABrokenFirstSceneCanBeReloaded) {
    file.error = "room.xml:1:1: empty";
    show();
    EXPECT_EQ(state().scene, nullptr);
    file.error.clear();
    reload();
    EXPECT_NE(state().scene, nullptr);
    type(Key::f5);
    EXPECT_TRUE(viewer.loading() || file.loads == 3);
}

TEST_F(SceneChange, NotesBelongToTheSceneOnShow) {
    file.notes = {{"room.xml:3:1: odd"}, {"room.xml:4:1: strange"}};
    show();
    state().add_message(Message::Kind::note, "something else");
    EXPECT_EQ(state().messages.size(), 3u);
    file.notes = {{"room.xml:3:1: odd"}};
    reload();
    EXPECT_EQ(state().messages.size(), 2u);
    EXPECT_TRUE(says("odd"));
    EXPECT_TRUE(says("something else"));
    EXPECT_FALSE(says("strange"));
}

TEST_F(SceneChange, TheListScrollsToAnErrorAfterFiveHundredNotes) {
    for (int i = 0; i < 500; ++i)
        file.notes.push_back(
            {"room.xml:" + std::to_string(i) +
             ":3: the bsdf 'coated' is not known; diffuse magenta is used instead (also at 12:3, 34:5, "
             "70:9 and 12 more places)"});
    show();
    EXPECT_EQ(state().messages.size(), 500u);
    state().rendering.paused = true;
    type(Key::f2);
    frames(3);
    save("notes.png");
    const ScreenPixels top = screen();
    file.error = "room.xml:7:3: no such thing";
    file.notes.clear();
    reload();
    frames(3);
    EXPECT_EQ(state().messages.size(), 501u);
    EXPECT_FALSE(state().wishes.scroll_to_newest);
    EXPECT_NE(screen().rgb, top.rgb) << "the list does not scroll to its end";
    save("notes_error.png");
    click("hide_messages"); // the buttons do not scroll
    EXPECT_FALSE(state().layout.show_messages);
}

TEST_F(SceneChange, DroppedSceneIsLoaded) {
    show();
    state().camera.orbit({30, 10}, 100);
    viewer.drop({"notes.txt", "/scenes/other.XML", "third.xml"});
    settle();
    EXPECT_EQ(opened, "/scenes/other.XML");
    EXPECT_EQ(state().scene_info.name, "/scenes/other.XML");
    EXPECT_TRUE(state().camera.camera() == state().scene->camera()) << "another scene starts with its own camera";
    EXPECT_TRUE(state().messages.empty());
    reload();
    EXPECT_EQ(state().scene_info.name, "/scenes/other.XML");
    EXPECT_EQ(file.loads, 3);
}

TEST_F(SceneChange, ClosedPanesGetTheDepthOfTheScene) {
    show();
    state().linked = false;
    state().set_pane_count(2);
    for (PaneState& pane : state().panes)
        pane.settings.render.max_depth = 31;
    state().set_pane_count(1);
    viewer.drop({"other.xml"});
    settle();
    state().set_pane_count(2);
    EXPECT_NE(state().panes[0].settings.render.max_depth, 31);
    EXPECT_EQ(state().panes[1].settings.render.max_depth, state().panes[0].settings.render.max_depth);
}

TEST_F(SceneChange, ADroppedFileOfAnotherTypeGivesAMessage) {
    show();
    viewer.drop({"/pictures/cat.png", "list.txt"});
    viewer.drop({});
    frames(3);
    EXPECT_FALSE(viewer.loading());
    EXPECT_TRUE(opened.empty());
    ASSERT_EQ(state().messages.size(), 1u);
    EXPECT_TRUE(says("/pictures/cat.png: the file type is unknown"));
}

TEST_F(SceneChange, ABrokenDroppedSceneKeepsTheOldOneWhichReloads) {
    show();
    file.error = "other.xml:1:1: broken";
    viewer.drop({"other.xml", "of_other.json"});
    settle();
    EXPECT_EQ(state().scene_info.name, "room.xml");
    EXPECT_TRUE(says("other.xml:1:1"));
    EXPECT_TRUE(state().wishes.open_settings.empty());
    EXPECT_FALSE(says("of_other.json")) << "its settings do not apply to the scene on show";
    file.error.clear();
    reload();
    EXPECT_EQ(state().scene_info.name, "room.xml");
    EXPECT_EQ(state().scene_info.shown, 2);
    EXPECT_TRUE(state().messages.empty());
}

TEST_F(SceneChange, LoadingShowsProgressAndIsCancelledByAnother) {
    show();
    std::atomic<bool> ended{false};
    viewer.load("slow.xml", [&](SceneNotes&, LoadProgress& progress) -> std::shared_ptr<const Scene> {
        progress.begin(LoadProgress::Stage::files, 8);
        progress.step();
        progress.step();
        while (!progress.given_up())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ended = true;
        progress.throw_if_cancelled();
        return nullptr;
    });
    wait_until([&] { return state().scene_info.loading == "meshes and textures, 2 of 8"; });
    save("progress.png");
    EXPECT_FALSE(ended);
    viewer.drop({"quick.xml"});
    settle();
    EXPECT_EQ(state().scene_info.name, "quick.xml");
    EXPECT_TRUE(state().scene_info.loading.empty());
    wait_until([&] { return ended.load(); });
    frames(5);
    EXPECT_TRUE(state().messages.empty()) << "a cancelled load gives no message";
}

TEST_F(SceneChange, LoadingIsCancelledByTheButtonAndByEscape) {
    show();
    for (const bool by_key : {false, true}) {
        std::atomic<bool> ended{false};
        viewer.load("slow.xml", [&](SceneNotes&, LoadProgress& progress) -> std::shared_ptr<const Scene> {
            progress.begin(LoadProgress::Stage::files, 8);
            while (!progress.given_up())
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            ended = true;
            progress.throw_if_cancelled();
            return nullptr;
        });
        wait_until([&] { return !state().scene_info.loading.empty() && has("cancel_load"); });
        viewer.drop({"of_slow.json"});
        frames(2);
        save("cancel_load.png");
        if (by_key) {
            state().layout.show_help = true;
            type(Key::escape); // only closes the help
            EXPECT_FALSE(state().layout.show_help);
            EXPECT_TRUE(viewer.loading());
            type(Key::escape);
        } else {
            click("cancel_load");
        }
        EXPECT_FALSE(viewer.loading());
        EXPECT_TRUE(state().scene_info.loading.empty());
        wait_until([&] { return ended.load(); });
        frames(3);
        EXPECT_EQ(state().scene_info.name, "room.xml");
        EXPECT_TRUE(says("slow.xml was cancelled"));
        EXPECT_FALSE(says("of_slow.json"));
        EXPECT_FALSE(has("cancel_load"));
    }
}

TEST_F(SceneChange, EndsWhileASceneIsLoading) {
    viewer.load("slow.xml", [&](SceneNotes&, LoadProgress& progress) -> std::shared_ptr<const Scene> {
        while (!progress.given_up())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return nullptr;
    });
    frames(2);
    EXPECT_TRUE(viewer.loading());
}

TEST_F(SceneChange, LongNamesLeaveRoomForTheMessages) {
    file.notes = {{"odd"}};
    viewer.load("/home/somebody/" + std::string(400, 'x') + "/scene.xml", file.loader());
    settle();
    EXPECT_LE(place("messages").max.x, 1280);
    save("long_name.png");
}

} // namespace
} // namespace tessera::test
