// Tooltips, typed values and shortcuts.

#include "tests/ui/viewer_harness.h"
#include "ui/panes/pane_parts.h"

#include <cstdint>
#include <set>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <imgui.h>

namespace tessera::test {
namespace {

struct Explained : testing::Test, ViewerHarness {
    Explained() : ViewerHarness({1600, 1000}) { rest(3); }

    /// Returns the ids of controls without a tooltip, except menus and pictures.
    std::set<std::string> silent() {
        std::set<std::string> result;
        for (const std::string& id : viewer.controls().unexplained())
            if (!id.ends_with(".picture") && !(id.starts_with("menu ") && id.find('/') == std::string::npos))
                result.insert(id);
        return result;
    }
    void press_text(const char* text) {
        for (const char* c = text; *c; ++c) {
            ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(*c));
            frame();
        }
    }
    void select_all_and_type(const std::string& control, const char* text) {
        click_at(control, 0.2f);
        click_at(control, 0.2f); // a double click selects all text
        press_text(text);
    }
};

using Silent = std::set<std::string>;

TEST_F(Explained, EveryControlHasATooltip) {
    state().panes[0].settings.buffer = Buffer::reused;
    state().panes[0].settings.render.method = Method::pr;
    Layout& layout = state().layout;
    layout.show_panel = layout.show_statistics = layout.show_charts = layout.show_messages = layout.show_help =
        true;
    state().add_message(Message::Kind::note, "a note");
    state().messages.back().samples = {SampleChoice{}};
    state().rendering.size.base = SizeChoice::Base::custom;
    state().active_pane = 0;
    state().panes[0].settings.comparison.kind = Comparison::Kind::wipe;
    frames(4);
    EXPECT_EQ(silent(), Silent());
    EXPECT_TRUE(has("pane0.wipe"));
    EXPECT_TRUE(has("scene_name"));
    state().layout.show_help = state().layout.show_messages = false;
    frames(2);
    EXPECT_EQ(silent(), Silent());
    for (const char* menu : {"File", "Render", "Buffer", "View", "Panes", "Camera", "Help"}) {
        click("menu " + std::string(menu));
        EXPECT_EQ(silent(), Silent()) << menu;
        click("menu " + std::string(menu)); // closes the menu
    }
    for (const char* choice : {"pane0.method", "pane0.buffer", "compare", "compare_with", "size", "tone", "norm",
                               "equal", "roulette", "charts.axis", "pattern"}) {
        click_at(choice, 0.3f);
        ASSERT_TRUE(viewer.controls().rects().upper_bound(std::string(choice) + "/") !=
                    viewer.controls().rects().end());
        EXPECT_EQ(silent(), Silent()) << choice;
        click(glm::vec2(3, 995)); // closes the list
    }
}

TEST_F(Explained, TheInspectorsControlsHaveTooltips) {
    state().inspector.active = true;
    state().inspector.sample = SampleChoice{1, {20, 20}, {}};
    wait_until([&] { return state().inspector.inspection != nullptr; });
    frames(3);
    EXPECT_EQ(silent(), Silent());
}

TEST_F(Explained, OverlaysOfPicturesHaveTooltips) {
    for (auto show :
         {+[](ViewerState& s) { s.set_slow_motion(true); }, +[](ViewerState& s) { s.layout.large_charts = true; },
          +[](ViewerState& s) { s.reference_making.show = true; },
          +[](ViewerState& s) { s.layout.sample_form.show = true; },
          +[](ViewerState& s) { s.layout.choosing = FilePurpose::scene; }}) {
        show(state());
        wait_until([&] { return !state().slow_motion.active || state().slow_motion.shows_choice(); });
        frames(4);
        EXPECT_EQ(silent(), Silent());
        type(Key::escape);
    }
}

TEST_F(Explained, ValuesHaveUnits) {
    const auto help_of = [&](const char* buffer) {
        choose("pane1.buffer", buffer);
        return cursor_help(showing_at(state(), 1, 0.5f), state());
    };
    EXPECT_NE(help_of("depth").find("in units"), std::string::npos);
    EXPECT_EQ(help_of("depth").find("luminance"), std::string::npos);
    EXPECT_NE(help_of("survival").find("in %"), std::string::npos);
    EXPECT_NE(help_of("outcomes").find("outcomes of the shifts"), std::string::npos);
    EXPECT_NE(help_of("normal").find("x, y and z"), std::string::npos);
    EXPECT_NE(help_of("primal").find("luminance (Y)"), std::string::npos);
}

TEST_F(Explained, ATypedNumberIsSetWhenTheControlLosesFocus) {
    state().rendering.paused = true;
    select_all_and_type("spp_limit", "64");
    EXPECT_EQ(state().rendering.pace.spp_limit, 3); // not set yet
    click("pane0.picture");
    EXPECT_EQ(state().rendering.pace.spp_limit, 64);
    select_all_and_type("seconds_limit", "2.5");
    click("pane0.picture");
    EXPECT_EQ(state().rendering.pace.seconds_limit, 2.5);
    state().rendering.pace.seconds_limit = 0;
    state().rendering.pace.equal = Pace::Equal::spp;
    frames(2);
    EXPECT_FALSE(has("seconds_limit")) << "there is one limit at a time";
    click_at("spp_limit", 0.97f); // the button
    EXPECT_EQ(state().rendering.pace.spp_limit, 65);
    choose("size", "custom");
    const std::uint64_t before = pane(0).generation;
    select_all_and_type("width", "33");
    EXPECT_EQ(pane(0).generation, before); // digits do not restart the render
    click("pane0.picture");
    EXPECT_EQ(state().rendering.size.custom.x, 33);
}

TEST_F(Explained, ATypedFileIsSetWhenTheControlLosesFocus) {
    click_at("reference", 0.3f);
    press_text("absent.exr");
    click("pane0.picture");
    wait_until([&] { return !state().messages.empty(); });
    EXPECT_NE(state().messages.back().text.find("absent.exr"), std::string::npos);
}

} // namespace
} // namespace tessera::test
