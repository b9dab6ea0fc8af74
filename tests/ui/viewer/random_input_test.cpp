// Drives the viewer with random input for TESSERA_RANDOM_SECONDS (5). It must survive and work afterwards.
// TESSERA_RANDOM_SEED repeats a run, apart from the timing of threads. random_run.sh runs it with sanitizers.

#include "render/io/exr.h"
#include "tests/ui/viewer_harness.h"
#include "ui/gl/gui.h"
#include "ui/state/actions.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <glm/mat4x4.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

double number_from(const char* variable, double otherwise) {
    const char* text = std::getenv(variable);
    return text ? std::atof(text) : otherwise;
}

/// Files to drop on the window, some of them broken, in a temporary current folder.
class Files {
public:
    Files() {
        fs::create_directories(folder_ / "config");
        fs::current_path(folder_);
        write("scene.xml", "<scene version=\"3.0.0\"><shape type=\"sphere\"/></scene>");
        write("broken.xml", "<scene version=\"3.0.0\"><shape type=\"sphere\"");
        write("settings.json", "{\"panes\": [{\"method\": \"gpr\", \"settings\": {\"tile\": \"9\"}}]}");
        write("broken.json", "{\"panes\": [{\"method\": \"gpr\", \"settings\": {\"tile\": \"99\"}}]}");
        write("broken.exr", "no picture");
        write_exr(folder_ / "picture.exr", {{{"", RgbImage(48, 36, Rgb(0.5f))}}, {}});
        write("empty", "");
    }
    ~Files() {
        fs::current_path(before_);
        fs::remove_all(folder_);
    }

    fs::path any(std::mt19937& random) const {
        const char* names[] = {"scene.xml",   "broken.xml", "settings.json", "broken.json",
                               "picture.exr", "broken.exr", "empty",         "not there.xml"};
        std::vector<fs::path> all(std::begin(names), std::end(names));
        for (const auto& entry : fs::directory_iterator(folder_)) // files that the viewer has saved
            all.push_back(entry.path().filename());
        return folder_ / all[random() % all.size()];
    }
    fs::path preferences() const { return folder_ / "config/viewer.json"; }

private:
    void write(const char* name, const char* text) const { std::ofstream(folder_ / name) << text; }

    fs::path before_ = fs::current_path();
    fs::path folder_ = fs::temp_directory_path() / fmt::format("tessera-random-{}", ::getpid());
};

ViewerOptions options_for(const Files& files) {
    ViewerOptions options = ViewerHarness::two_panes();
    options.preferences = files.preferences();
    options.open = [](const fs::path& file) -> SceneOrigin {
        const auto loader = [file](SceneNotes&, LoadProgress&) {
            if (file.filename() != "scene.xml")
                throw std::runtime_error(file.string() + ":1:1: is broken");
            return viewer_scene();
        };
        return {file.string(), {file, {}, {}}, loader};
    };
    options.write_exr = [](const fs::path& file, const SavedPicture& picture) {
        write_exr(file, {{{"", picture.snapshot->images->primal}}, {}});
    };
    return options;
}

class RandomInput : public testing::Test {
protected:
    template <class Real>
    Real real(Real least, Real most) {
        return std::uniform_real_distribution<Real>(least, most)(random_);
    }
    int integer(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
    bool one_in(int n) { return integer(1, n) == 1; }

    /// Returns a random position, mostly on a control.
    glm::vec2 anywhere() {
        const auto& controls = viewer().controls().rects();
        if (controls.empty() || one_in(3))
            return glm::vec2(harness_->context.size()) * glm::vec2(real(-0.1f, 1.1f), real(-0.1f, 1.1f));
        const auto chosen = std::next(controls.begin(), integer(0, static_cast<int>(controls.size()) - 1));
        note("on " + chosen->first);
        return {real(chosen->second.min.x, chosen->second.max.x),
                real(chosen->second.min.y, chosen->second.max.y)};
    }

    void act() {
        switch (integer(0, 9)) {
        case 0:
        case 1: {
            const glm::vec2 p = anywhere();
            note(fmt::format("mouse to {}, {}", p.x, p.y));
            return send_mouse_position({p.x, p.y});
        }
        case 2:
        case 3: {
            const int button = one_in(3) ? integer(0, 2) : 0;
            const bool down = one_in(2);
            note(fmt::format("button {} {}", button, down));
            return send_mouse_button(button, down);
        }
        case 4:
            return send_mouse_wheel(real(-3.0f, 3.0f));
        case 5:
            return send_modifiers(one_in(4), one_in(4));
        case 6:
            return press_key();
        case 7:
            return type_text();
        case 8:
            return run_action();
        default:
            return do_rarer_things();
        }
    }

    void press_key() {
        const Key key = static_cast<Key>(integer(1, static_cast<int>(Key::count) - 1));
        const bool ctrl = one_in(5), shift = one_in(4);
        note(fmt::format("key {}", to_string(Shortcut{key, ctrl, shift})));
        viewer().keyboard().press(key, key, ctrl, shift);
        if (!one_in(4)) // otherwise the key stays down
            viewer().keyboard().release(key);
    }

    void type_text() {
        constexpr std::string_view characters = "0123456789.-+eE?[]/ax \n\t\x7f";
        const char c = characters[integer(0, static_cast<int>(characters.size()) - 1)];
        note(fmt::format("character {}", static_cast<int>(c)));
        ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
        viewer().keyboard().type(c);
    }

    void run_action() {
        const Action& action = actions()[integer(0, static_cast<int>(actions().size()) - 1)];
        note(fmt::format("action {}", action.name));
        action.run(harness_->state());
    }

    void do_rarer_things() {
        if (one_in(8)) {
            const glm::ivec2 size = one_in(3) ? glm::ivec2(1) : glm::ivec2(integer(1, 1000), integer(1, 700));
            note(fmt::format("window {}x{}", size.x, size.y));
            harness_->context.resize(size);
        } else if (one_in(8)) {
            const fs::path file = files_.any(random_);
            note("drop " + file.string());
            viewer().drop({file});
        } else if (one_in(8)) {
            note("another scene");
            viewer().load("a room", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
        } else if (one_in(40)) {
            note("the viewer anew");
            harness_.reset();
            harness_ = new_viewer();
            harness_->load_scene();
        }
    }

    /// Uses several threads per pass, for the thread sanitizer.
    std::unique_ptr<ViewerHarness> new_viewer() const {
        return std::make_unique<ViewerHarness>(glm::ivec2(900, 600), 1.0f, options_for(files_), 3);
    }

    void check() {
        const ViewerState& state = harness_->state();
        ASSERT_GE(state.panes.size(), 1u);
        ASSERT_LE(state.panes.size(), static_cast<std::size_t>(most_panes));
        ASSERT_GE(state.active_pane, 0);
        ASSERT_LT(state.active_pane, static_cast<int>(state.panes.size()));
        const glm::mat4& to_world = state.camera.camera().to_world;
        for (int i = 0; i < 16; ++i)
            ASSERT_TRUE(std::isfinite(to_world[i / 4][i % 4]));
        ASSERT_TRUE(std::isfinite(state.display.tone.exposure));
    }

    /// Keeps the last lines, which are printed after a failure.
    void note(std::string what) {
        last_.push_back(std::move(what));
        if (last_.size() > 40)
            last_.pop_front();
    }

    Viewer& viewer() { return harness_->viewer; }

    Files files_;
    std::mt19937 random_;
    std::deque<std::string> last_;
    std::unique_ptr<ViewerHarness> harness_;
};

/// Returns the resident memory, MiB.
double resident() {
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024 * 1024);
}

TEST_F(RandomInput, BreaksNothing) {
    const auto seed = static_cast<unsigned>(number_from("TESSERA_RANDOM_SEED", std::random_device()() % 100000));
    const double seconds = number_from("TESSERA_RANDOM_SECONDS", 5);
    fmt::print("TESSERA_RANDOM_SEED={}\n", seed);
    random_.seed(seed);
    harness_ = new_viewer();
    harness_->load_scene();
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    long events = 0, frames = 0;
    for (double said = 0; elapsed() < seconds; ++frames) {
        for (int i = integer(0, 4); i > 0; --i, ++events)
            act();
        harness_->state().wishes.quit = false;
        harness_->frame(real(0.0f, 0.1f));
        check();
        if (HasFatalFailure())
            break;
        if (elapsed() > said + seconds / 10) {
            said = elapsed();
            fmt::print("{:.0f} s, {} frames, {} events, {:.0f} MiB\n", said, frames, events, resident());
            std::fflush(stdout);
        }
    }
    if (HasFailure())
        for (const std::string& line : last_)
            fmt::print("  {}\n", line);

    // Ctrl+Q quits in any state.
    harness_->state().wishes.quit = false;
    viewer().keyboard().press(Key::q, Key::q, true, false);
    harness_->frame(0.02f);
    EXPECT_TRUE(harness_->state().wishes.quit);

    // A new viewer works as usual.
    harness_.reset();
    harness_ = std::make_unique<ViewerHarness>();
    harness_->rest(4);
    EXPECT_EQ(harness_->pane(0).snapshot->spp, 4);
}

} // namespace
} // namespace tessera::test
