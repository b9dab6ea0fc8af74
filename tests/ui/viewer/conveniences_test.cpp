// Automatic exposure, command palette, undo by keys, toasts, arrangement of panes, presets.

#include "render/scene/scene.h"
#include "tests/ui/drawing/panes_fixture.h"
#include "tests/ui/viewer/current_folder.h"
#include "ui/settings/presets.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <imgui.h>

namespace tessera::test {
namespace {

TEST_F(Panes, AutomaticExposureFitsTheShownPicture) {
    const double good = brightness("pane1.picture");
    state().display.tone.exposure = -9;
    frames(2);
    ASSERT_LT(brightness("pane1.picture"), good / 4);
    type(Key::f6);
    frames(2);
    EXPECT_GT(brightness("pane1.picture"), good / 2);
    EXPECT_LT(brightness("pane1.picture"), 220);
    state().active_pane = 1;
    state().panes[1].settings.buffer = Buffer::dx;
    const float of_picture = state().display.tone.exposure;
    frames(3);
    const double dim = brightness("pane1.picture"), other = brightness("pane0.picture");
    type(Key::f6);
    frames(2);
    EXPECT_EQ(state().display.tone.exposure, of_picture);
    EXPECT_GT(state().display.tone.difference_exposure, 0) << "gradients are darker";
    EXPECT_GT(brightness("pane1.picture"), dim + 3);
    EXPECT_EQ(brightness("pane0.picture"), other) << "the other picture does not change";
    save("gradients-exposed.png");
    type(Key::z, true);
    frames(2);
    EXPECT_EQ(state().display.tone.difference_exposure, 0) << "it can be undone";
    type(Key::digit0);
    state().panes[1].settings.buffer = Buffer::reused;
    state().display.ranges[Buffer::reused] = {0, 1e6f, false};
    frames(3);
    type(Key::f6);
    frames(2);
    EXPECT_LT(state().display.ranges[Buffer::reused].high, 1e4f);
}

TEST_F(Panes, CommandsAreFoundByText) {
    type(Key::p, true, true);
    ASSERT_TRUE(has("palette.text"));
    frames(2);
    for (char c : std::string_view("four pan"))
        ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(c));
    frames(3);
    save("palette.png");
    ASSERT_TRUE(has("palette/Four panes"));
    EXPECT_FALSE(has("palette/Quit"));
    type(Key::enter);
    frames(2);
    EXPECT_FALSE(has("palette.text"));
    EXPECT_EQ(state().panes.size(), 4u);
    type(Key::p, true, true);
    EXPECT_TRUE(has("palette/Quit")) << "the search text is empty at first";
    type(Key::down);
    type(Key::escape);
    EXPECT_FALSE(has("palette.text"));

    const Method method = state().active().settings.render.method;
    state().layout.show_palette = true;
    type(Key::m); // before the text field has the focus
    EXPECT_EQ(state().active().settings.render.method, method);
    EXPECT_TRUE(state().layout.show_palette);
}

TEST_F(Panes, TheHelpIsFilteredByText) {
    state().layout.show_help = true;
    frames(3);
    ASSERT_TRUE(has("help.text"));
    save("help.png");
    const ScreenPixels all = screen();
    click("help.text");
    for (char c : std::string_view("roulette"))
        ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(c));
    frames(3);
    save("help-found.png");
    const ScreenPixels found = screen();
    std::size_t changed = 0;
    for (std::size_t i = 0; i < all.rgb.size(); ++i)
        changed += all.rgb[i] != found.rgb[i];
    EXPECT_GT(changed, 20000u) << "other lines are hidden";
    EXPECT_TRUE(state().layout.show_help);
    type(Key::escape); // leaves the text field
    type(Key::escape);
    frames(2);
    EXPECT_FALSE(has("help.text"));
}

TEST_F(Panes, KeysUndoChanges) {
    frames(3);
    const Camera before = state().camera.camera();
    drag(point(0, 0.4f, 0.4f), {60, 10});
    frames(2);
    ASSERT_FALSE(state().camera.camera() == before);
    const Camera after = state().camera.camera();
    type(Key::z, true);
    EXPECT_TRUE(state().camera.camera() == before) << "a drag is one step";
    type(Key::z, true, true);
    EXPECT_TRUE(state().camera.camera() == after);
}

TEST(Toast, ShowsTheSavedFileAndDisappears) {
    const CurrentFolder folder;
    ViewerHarness h;
    h.rest(1);
    h.type(Key::k);
    h.finish_saving();
    h.frames(2);
    EXPECT_TRUE(h.has("toast"));
    EXPECT_NE(h.state().layout.toast.text.find((folder.path / "tessera-camera.json").string()), std::string::npos)
        << h.state().layout.toast.text;
    h.save("toast.png");
    h.frame(static_cast<float>(Toast::seconds) + 1);
    h.frames(3);
    EXPECT_FALSE(h.has("toast"));
    EXPECT_FALSE(h.state().messages.empty()) << "the message stays in the list";
}

/// Whether two panes lie above each other for a scene with this film size.
bool are_stacked(ViewerHarness& h, glm::ivec2 film) {
    h.viewer.load("film", [film](SceneNotes&, LoadProgress&) {
        SceneDescription description = viewer_scene()->description();
        description.size = film;
        return std::make_shared<const Scene>(std::move(description));
    });
    const int before = h.state().scene_info.shown;
    h.wait_until([&] { return h.state().scene_info.shown > before; });
    h.frames(3);
    return h.place("pane0.picture").max.y <= h.place("pane1.picture").min.y;
}

TEST(PanesByAspect, TwoPanesMaximisePictureSize) {
    ViewerHarness h({1440, 810});
    EXPECT_TRUE(are_stacked(h, {320, 120}));
    EXPECT_FALSE(are_stacked(h, {200, 200}));
    h.resize({600, 810});
    h.frames(3);
    EXPECT_LE(h.place("pane0.picture").max.y, h.place("pane1.picture").min.y) << "a narrow window";
}

TEST_F(Panes, PresetsMarkDifferencesAndResetThem) {
    state().active_pane = 1;
    choose("preset", "bauszat2017");
    frames(2);
    EXPECT_EQ(preset_of(pane(1).settings), state().preset);
    EXPECT_EQ(pane(1).settings.render.rr_delta, 0.1f);
    EXPECT_EQ(pane(0).settings.render.roulette, RouletteKind::absolute) << "linked panes have the same settings";
    EXPECT_TRUE(has("rr_delta"));
    click_at("tile", 0.99f);
    ASSERT_NE(pane(1).settings.render.tile, 6);
    save("preset-changed.png");
    reveal("tile");
    move_to(place("tile").center());
    press(1);
    release(1);
    EXPECT_EQ(pane(1).settings.render.tile, 6);
    EXPECT_EQ(pane(0).settings.render.tile, 6);
    EXPECT_EQ(preset_of(pane(1).settings), state().preset);
    click_at("tile", 0.99f);
    ASSERT_NE(pane(1).settings.render.tile, 6);
    choose("preset", "bauszat2017");
    EXPECT_EQ(pane(1).settings.render.tile, 6) << "chosen again";
}

TEST(PaneHeaders, SetTileAndNormOfOnePane) {
    ViewerHarness h({1600, 900});
    h.rest(1);
    EXPECT_FALSE(h.has("pane0.tile")) << "PT has no tiles";
    ASSERT_TRUE(h.has("pane1.tile"));
    h.choose("pane1.norm", "l1");
    EXPECT_EQ(h.pane(1).settings.reconstruction.norm, Norm::l1);
    EXPECT_FALSE(h.state().linked) << "the change applies to this pane only";
    EXPECT_NE(h.pane(0).settings.reconstruction.norm, Norm::l1);
    h.choose("pane1.tile", "3");
    EXPECT_EQ(h.pane(1).settings.render.tile, 3);
    h.save("header.png");
}

TEST(PaneHeaders, AClickSwitchesBetweenRawSamplesAndTheDenoiser) {
    ViewerHarness h({1600, 900});
    h.rest(1);
    const auto norm = [&](int pane) { return applied_norm(h.pane(pane).settings); };
    ASSERT_EQ(norm(0), Norm::none);
    ASSERT_EQ(norm(1), Norm::guided);
    h.click("pane1.denoised");
    EXPECT_EQ(norm(1), Norm::none);
    EXPECT_FALSE(h.state().linked) << "the change applies to this pane only";
    h.click("pane0.denoised");
    EXPECT_EQ(norm(0), Norm::smoothed);
    EXPECT_EQ(norm(1), Norm::none);
    h.save("header-raw.png");
    h.type(Key::z, true);
    EXPECT_EQ(norm(0), Norm::none);
    h.type(Key::z, true);
    EXPECT_EQ(norm(1), Norm::guided);
    EXPECT_TRUE(h.state().linked);
    h.state().active_pane = 0;
    h.type(Key::d, true);
    EXPECT_EQ(norm(0), Norm::smoothed);
    EXPECT_EQ(norm(1), Norm::guided);
    h.type(Key::d, true);
    EXPECT_EQ(norm(0), Norm::none);
}

} // namespace
} // namespace tessera::test
