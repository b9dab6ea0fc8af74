// Undo and redo, presets, and the search for commands.

#include "render/scene/scene.h"
#include "render/settings/settings_table.h"
#include "ui/panels/found_actions.h"
#include "ui/settings/presets.h"
#include "ui/state/history.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

Document document_with(int panes) {
    Document document;
    for (const PaneSettings& settings : default_panes(panes)) {
        document.panes.emplace_back().settings = settings;
        document.panes.back().slot = static_cast<int>(document.panes.size()) - 1;
    }
    return document;
}

/// Returns a scene with two sensors, of 96 x 64 and 50 x 40 pixels.
std::shared_ptr<const Scene> scene_with_two_sensors() {
    SceneDescription description;
    description.sensors = {{"", Camera{}, {96, 64}}, {"second", Camera{}, {50, 40}}};
    description.sensors[1].camera.fov = 60;
    description.sensors[1].camera.to_world[3].x = 3;
    description.use(description.sensors[0]);
    return std::make_shared<const Scene>(description);
}

TEST(Sensors, ASensorHasItsFilmAndIsTheHomeView) {
    Document document = document_with(1);
    EXPECT_EQ(document.sensor_size(), glm::ivec2(16, 9));
    document.scene = scene_with_two_sensors();
    document.camera.set_home(document.scene->camera(), {0, 0, 5}, 1);
    EXPECT_EQ(document.sensor_size(), glm::ivec2(96, 64));
    History history;
    history.note(document, false);
    document.show_sensor(1);
    history.note(document, false);
    EXPECT_EQ(document.sensor_size(), glm::ivec2(50, 40));
    EXPECT_EQ(document.camera.camera().fov, 60);
    document.camera.fly({0, 0, 1});
    document.camera.go_home();
    EXPECT_FLOAT_EQ(document.camera.position().x, 3);
    history.undo(document);
    EXPECT_EQ(document.sensor_size(), glm::ivec2(96, 64));
    EXPECT_FLOAT_EQ(document.camera.position().x, 0);
    history.redo(document);
    EXPECT_EQ(document.sensor_size(), glm::ivec2(50, 40));
    EXPECT_FLOAT_EQ(document.camera.position().x, 3);
}

TEST(History, UndoesAndRedoes) {
    Document document = document_with(2);
    History history;
    history.note(document, false);
    EXPECT_FALSE(history.can_undo());
    document.panes[1].settings.render.tile = 3;
    history.note(document, false);
    document.camera.fly({0, 0, 1});
    const glm::vec3 flown = document.camera.position();
    history.note(document, false);
    history.undo(document);
    EXPECT_NE(document.camera.position(), flown);
    EXPECT_EQ(document.panes[1].settings.render.tile, 3);
    history.undo(document);
    EXPECT_EQ(document.panes[1].settings.render.tile, RenderSettings().tile);
    EXPECT_FALSE(history.can_undo());
    history.undo(document); // has no effect
    history.redo(document);
    history.redo(document);
    EXPECT_EQ(document.camera.position(), flown);
    EXPECT_EQ(document.panes[1].settings.render.tile, 3);
    EXPECT_FALSE(history.can_redo());
}

TEST(History, ADragIsOneStep) {
    Document document = document_with(1);
    History history;
    history.note(document, false);
    for (int i = 0; i < 50; ++i) {
        document.camera.orbit({5, 0}, 400);
        history.note(document, true);
    }
    history.note(document, false);
    history.undo(document);
    EXPECT_FALSE(history.can_undo());
}

TEST(History, UndoRestoresPanesWithTheirSettings) {
    Document document = document_with(2);
    document.panes[0].settings.render.tile = 5;
    document.linked = false;
    History history;
    history.note(document, false);
    document.set_pane_count(1);
    history.note(document, false);
    history.undo(document);
    ASSERT_EQ(document.panes.size(), 2u);
    EXPECT_EQ(document.panes[0].settings.render.tile, 5);
    EXPECT_EQ(document.panes[0].settings.render.method, Method::pt);
    EXPECT_FALSE(document.linked);
}

TEST(History, AChangeAfterUndoClearsRedo) {
    Document document = document_with(1);
    History history;
    for (float exposure : {0.0f, 1.0f, 2.0f}) {
        document.display.tone.exposure = exposure;
        history.note(document, false);
    }
    history.undo(document);
    document.display.tone.exposure = 7;
    history.note(document, false);
    EXPECT_FALSE(history.can_redo());
    history.undo(document);
    EXPECT_EQ(document.display.tone.exposure, 1);
}

TEST(Presets, AreRecognisedForAnyMethod) {
    for (std::size_t i = 0; i < presets().size(); ++i) {
        for (Method method : all_methods) {
            PaneSettings pane;
            pane.render.method = method;
            pane.render.max_depth = 17;
            pane.render.seed = 5;
            pane.render.edge_rays = i != 0;
            pane.buffer = Buffer::dx;
            apply(presets()[i], pane);
            EXPECT_EQ(pane.render.method, method);
            EXPECT_EQ(pane.render.max_depth, 17);
            EXPECT_EQ(pane.render.seed, 5u);
            EXPECT_EQ(pane.buffer, Buffer::dx);
            EXPECT_EQ(pane.render.edge_rays, i == 0) << "as published";
            EXPECT_EQ(preset_of(pane), static_cast<int>(i));
            EXPECT_NO_THROW(check(pane.render));
            pane.render.tile = 11;
            EXPECT_EQ(preset_of(pane), -1);
        }
    }
    EXPECT_EQ(preset_of(PaneSettings()), 0) << "the defaults are a preset";
}

TEST(FoundActions, ContainAllSearchWords) {
    EXPECT_EQ(actions_with("").size(), actions().size());
    const auto found = actions_with("four pane");
    ASSERT_FALSE(found.empty());
    EXPECT_STREQ(found.front()->name, "Four panes");
    EXPECT_TRUE(actions_with("four xyzzy").empty());
    const auto by_key = actions_with("ctrl+shift+z");
    EXPECT_TRUE(std::any_of(by_key.begin(), by_key.end(),
                            [](const Action* action) { return std::string(action->name) == "Redo"; }));
}

TEST(DefaultPanes, FourShowTheFourMethods) {
    Document document = document_with(2);
    document.active_pane = 1;
    const auto method = [&](std::size_t i) { return document.panes[i].settings.render.method; };
    document.set_pane_count(4);
    EXPECT_EQ(method(0), Method::pt);
    EXPECT_EQ(method(1), Method::pr);
    EXPECT_EQ(method(2), Method::gpt);
    EXPECT_EQ(method(3), Method::gpr);
    EXPECT_EQ(document.active().settings.render.method, Method::gpr) << "the active pane stays";
    document.set_pane_count(2);
    EXPECT_EQ(method(0), Method::pt);
    EXPECT_EQ(method(1), Method::gpr);
    EXPECT_EQ(document.active_pane, 1);
}

} // namespace
} // namespace tessera
