// Each action of the table, by menu and by keys: its effect on the state and on the screen.

#include "render/io/exr.h"
#include "tests/ui/viewer/current_folder.h"
#include "tests/ui/viewer_harness.h"
#include "ui/gl/gui.h"
#include "ui/settings/settings_file.h"
#include "ui/state/actions.h"

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;
constexpr int samples = 3; // per pixel at which panes stop

/// Makes a change that can be undone.
void note_two_exposures(ViewerState& s) {
    s.history = {};
    s.history.note(s, false);
    s.display.tone.exposure = 2;
    s.history.note(s, false);
}

/// Preparations without which an action would change nothing.
const std::map<std::string, std::function<void(ViewerState&)>> preparations = {
    {"Result", [](ViewerState& s) { s.panes[0].settings.buffer = s.panes[1].settings.buffer = Buffer::dx; }},
    {"Reset exposure", [](ViewerState& s) { s.display.tone.exposure = 2; }},
    {"Next component",
     [](ViewerState& s) {
         s.active().settings.render.basis = Basis::sh1;
         s.active().settings.buffer = Buffer::dx;
     }},
    {"Fit picture", [](ViewerState& s) { s.set_view(ImageView(2, {0.4f, 0.5f})); }},
    {"Smaller text", [](ViewerState& s) { s.layout.text_factor = 1.25f; }},
    {"Default text size", [](ViewerState& s) { s.layout.text_factor = 1.25f; }},
    {"Step one pass", [](ViewerState& s) { s.wishes.restart = true; }}, // a step may be complete already
    {"Two panes", [](ViewerState& s) { s.set_pane_count(4); }},
    {"Reset camera", [](ViewerState& s) { s.camera.orbit({40, 10}, 100); }},
    {"Next bookmark",
     [](ViewerState& s) {
         add_bookmark(s);
         s.camera.orbit({40, 10}, 100);
     }},
    {"Forget bookmark", [](ViewerState& s) { add_bookmark(s); }},
    {"Automatic exposure", [](ViewerState& s) { s.display.tone.exposure = 5; }},
    {"Undo", [](ViewerState& s) { note_two_exposures(s); }},
    {"Redo",
     [](ViewerState& s) {
         note_two_exposures(s);
         s.history.undo(s);
     }},
    {"Hold slow motion", [](ViewerState& s) { s.set_slow_motion(true); }},
    {"Next base path", [](ViewerState& s) { s.set_slow_motion(true); }},
    {"Previous base path", [](ViewerState& s) { s.set_slow_motion(true), s.slow_motion.current = 2; }},
    {"Next tile", [](ViewerState& s) { s.set_slow_motion(true); }},
};

/// Actions that may change no pixel of the window.
const std::set<std::string> unseen = {"Restart", "Quit"};

/// Returns the names of the menus, in the order of the table.
std::vector<std::string> menus() {
    std::vector<std::string> names;
    for (const Action& action : actions()) {
        if (names.empty() || names.back() != action.menu)
            names.emplace_back(action.menu);
    }
    return names;
}

struct EveryAction : testing::TestWithParam<std::string>, ViewerHarness {
    EveryAction() : ViewerHarness({1000, 800}) {
        state().rendering.pace.spp_limit = samples;
        viewer.load("room.xml", scene_in("room.xml").loader, scene_in("room.xml").source);
        write_exr("reference.exr", {{{"", RgbImage(48, 36, Rgb(0.5f))}}, {}});
        wait_until([&] { return viewer.settled(samples); });
        viewer.drop({"reference.exr"});
        wait_until([&] { return state().companions.reference != nullptr; });
        fs::remove("reference.exr");
        state().active_pane = 1;
        frames(3);
        plain = state();
    }

    /// Waits until all work of an action is done.
    void settle(int spp) {
        wait_until([&] {
            const SlowMotion& motion = state().slow_motion;
            return viewer.settled(spp) && (!motion.active || motion.shows_choice());
        });
        finish_saving();
        move_to({static_cast<float>(context.size().x) * 0.7f, 5}); // where there is no control
        wait_until([&] {
            return viewer.next_frame_in() > 0.1 || state().slow_motion.is_playing();
        }); // 0.2: a blinking cursor
        frames(2);
    }

    void start_from(const std::string& action) {
        for (const auto& file : fs::directory_iterator(fs::current_path()))
            fs::remove_all(file);
        ImGui::SetClipboardText("");
        const SlowMotion found = state().slow_motion; // so that its tile is not traced again
        state() = plain;
        state().slow_motion.tile = found.tile;
        state().slow_motion.slot = found.slot;
        state().slow_motion.generation = found.generation;
        if (const auto prepare = preparations.find(action); prepare != preparations.end())
            prepare->second(state());
        state().slow_motion.held = true;
        frames(2); // in which the request is sent
        settle(samples);
        scenes = state().scene_info.shown;
        generation = state().active().generation;
    }

    /// Returns all that an action may change, and the files that it may write, as text.
    std::string effects() {
        const ViewerState& s = state();
        std::multiset<std::string> files;
        for (const auto& file : fs::directory_iterator(fs::current_path()))
            files.insert(file.path().extension().string());
        std::string text = settings_json(s) + "files:";
        for (const std::string& kind : files)
            text += " " + kind;
        text += fmt::format("\nclipboard: {}\n", ImGui::GetClipboardText());
        text += fmt::format("part {}\n", s.companions.component ? *s.companions.component : -1);
        text += fmt::format("pane {}, text {}, {} spp, reloaded {}, anew {}, quit {}\n", s.active_pane,
                            s.layout.text_factor, s.active().snapshot->spp, s.scene_info.shown - scenes,
                            s.active().generation != generation, s.wishes.quit);
        text += fmt::format("paused {}, light {}, panel {}, statistics {}, charts {}, help {}, messages {}\n",
                            s.rendering.paused, s.layout.theme == Theme::light, s.layout.show_panel,
                            s.layout.show_statistics, s.layout.show_charts, s.layout.show_help,
                            s.layout.show_messages);
        text += fmt::format("choosing {}, sample form {}, reference form {}, inspector {}\n",
                            s.layout.choosing ? static_cast<int>(*s.layout.choosing) : -1,
                            s.layout.sample_form.show, s.reference_making.show, s.inspector.active);
        text += fmt::format("palette {}, jobs {}, gallery {}, panes {}\n", s.layout.show_palette,
                            s.layout.show_jobs, s.layout.show_gallery, s.panes.size());
        const SlowMotion& motion = s.slow_motion;
        text += fmt::format("slow motion {}, held {}, at {}", motion.active, motion.held,
                            motion.held ? static_cast<float>(motion.current) + motion.arrived : 0);
        if (motion.active && motion.sample)
            text += fmt::format(" of {}, {}", motion.sample->pixel.x, motion.sample->pixel.y);
        return text;
    }

    void type(const Shortcut& shortcut) {
        if (shortcut.character) {
            viewer.keyboard().type(shortcut.character);
            frames(2);
        } else {
            ViewerHarness::type(shortcut.key, shortcut.ctrl, shortcut.shift);
        }
    }

    /// Returns the effect of the action in this way, and expects a visible change.
    std::string done_by(const Action& action, const std::string& way, const std::function<void()>& run) {
        SCOPED_TRACE(action.name);
        start_from(action.name);
        const std::string before = effects();
        const auto pixels = screen().rgb;
        const bool was_checked = action.checked && action.checked(state());
        run();
        settle(std::string(action.name) == "Step one pass" ? samples + 1 : samples);
        const std::string after = effects();
        EXPECT_NE(after, before) << action.name << " by " << way << " does nothing";
        EXPECT_TRUE(screen().rgb != pixels || unseen.count(action.name)) << action.name << " by " << way;
        if (action.checked) {
            EXPECT_NE(action.checked(state()), was_checked) << action.name << " by " << way;
        }
        return after;
    }

    CurrentFolder folder;
    ViewerState plain; // the state of two panes at rest
    int scenes = 0;
    std::uint64_t generation = 0;
};

TEST_P(EveryAction, HasTheSameVisibleEffectByMenuAndByKeys) {
    for (const Action& action : actions()) {
        if (action.menu != GetParam())
            continue;
        const std::string menu = "menu " + GetParam();
        start_from(action.name); // waits for background results, so that neither way is the first
        const std::string by_menu = done_by(action, "menu", [&] {
            if (!is_in_menu(action))
                return command(action.name);
            click(menu);
            click(menu + "/" + action.name);
        });
        for (const Shortcut& shortcut : {action.shortcut, action.second_shortcut}) {
            if (shortcut == Shortcut{})
                continue;
            EXPECT_EQ(done_by(action, to_string(shortcut), [&] { type(shortcut); }), by_menu)
                << action.name << " by " << to_string(shortcut);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Menus, EveryAction, testing::ValuesIn(menus()), [](const auto& menu) {
    std::string name = menu.param;
    std::erase(name, ' '); // not allowed in a test name
    return name;
});

} // namespace
} // namespace tessera::test
