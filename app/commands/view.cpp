#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "app/experiment/stability.h"
#include "app/report/reports.h"
#include "render/io/available_memory.h"
#include "render/io/plain_images.h"
#include "ui/gl/gl.h"
#include "ui/settings/preferences.h"
#include "ui/viewer/script.h"
#include "ui/viewer/viewer.h"
#include "ui/window/surface.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>

namespace tessera {

namespace {

using WallClock = std::chrono::steady_clock;

void print_line(const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
}

std::string title(const std::string& scene) {
    return "Tessera - " + scene;
}

/// Work after each frame: saves pictures of the window, sets its title, and logs times.
class FrameDuties {
public:
    FrameDuties(const ViewOptions& options, Surface& surface, Viewer& viewer, WallClock::time_point start)
        : options_(options), surface_(surface), viewer_(viewer), start_(start) {}

    /// Returns false if the work is done and no frame is to follow.
    bool after_frame() {
        log_times();
        set_title();
        if (saver_.after_frame(viewer_.state(), viewer_.saver(), surface_.pixels()))
            surface_.wake();
        return options_.screenshot.empty() || take_screenshot();
    }

    int exit_code() const { return exit_code_; }

private:
    void log_times() {
        if (!options_.log_actions)
            return;
        const double seconds = std::chrono::duration<double>(WallClock::now() - start_).count();
        if (!window_logged_)
            print_line("time window " + std::to_string(seconds));
        window_logged_ = true;
        const auto& panes = viewer_.state().panes;
        const auto pictures = std::count_if(panes.begin(), panes.end(),
                                            [](const PaneState& pane) { return pane.snapshot != nullptr; });
        for (; pictures_logged_ < pictures; ++pictures_logged_)
            print_line("time picture " + std::to_string(seconds));
    }

    void set_title() {
        if (viewer_.state().scene_info.name == title_scene_)
            return;
        title_scene_ = viewer_.state().scene_info.name;
        surface_.set_title(title(title_scene_));
    }

    bool take_screenshot() {
        for (const Message& message : viewer_.state().messages) {
            if (message.kind == Message::Kind::error)
                return fail(message.text);
        }
        if (!viewer_.settled(viewer_.state().rendering.pace.spp_limit) || viewer_.inspecting() ||
            !viewer_.all_drawn())
            return true;
        try {
            const ScreenPixels screen = read_screen(surface_.pixels());
            write_png(options_.screenshot, screen.size, screen.rgb);
        } catch (const std::exception& e) {
            return fail(message_of(e));
        }
        return false;
    }

    bool fail(const std::string& text) {
        std::fprintf(stderr, "%s\n", text.c_str());
        exit_code_ = exit_bad_input;
        return false;
    }

    const ViewOptions& options_;
    Surface& surface_;
    Viewer& viewer_;
    WallClock::time_point start_;
    bool window_logged_ = false;
    std::ptrdiff_t pictures_logged_ = 0;
    std::string title_scene_; // the scene in the window's title
    PictureSaver saver_;
    int exit_code_ = 0;
};

/// Returns false for scripts and screenshots, which must not depend on saved preferences.
bool is_interactive(const ViewOptions& options) {
    return options.screenshot.empty() && options.script.empty();
}

/// Returns the position of the last window, with the requested size.
WindowPlace window_place(const ViewOptions& options) {
    std::string ignored; // the viewer reports it
    WindowPlace place =
        is_interactive(options) ? read_preferences(preferences_file(), ignored).window : WindowPlace{};
    if (options.window_size)
        place = {*options.window_size, place.position, false};
    if (place.size.x < 1)
        place.size = {1440, 810};
    return place;
}

std::unique_ptr<Surface> open_surface(const ViewOptions& options) {
    const SurfaceOptions wanted{title(options.scene.name), window_place(options),
                                !options.screenshot.empty() || !options.script.empty()};
    std::string error;
    std::unique_ptr<Surface> surface = open_window(wanted, error);
    if (!surface && wanted.exact_size)
        surface = open_offscreen(wanted, error);
    return surface;
}

ViewerOptions viewer_options(const ViewOptions& options, Surface& surface) {
    ViewerOptions result;
    result.panes = options.panes;
    result.max_depth = options.max_depth;
    result.size = options.render_size;
    result.threads = options.threads;
    result.spp_limit = options.screenshot.empty() || options.spp > 0 ? options.spp : default_spp;
    result.sample = options.sample;
    result.uses_stored_pane_count = options.uses_stored_pane_count;
    if (options.log_actions)
        result.log = print_line;
    result.log_controls = options.log_actions;
    result.reference = options.reference;
    result.open = options.open;
    result.write_exr = write_saved_picture;
    result.read_jobs = folder_reader;
    result.jobs = options.jobs;
    result.gallery = [] { return gallery(built_in_stability_scenes); };
    result.begins_with_gallery = options.shows_gallery && is_interactive(options) && options.jobs.empty() &&
                                 options.scene.source.file.empty() && !options.sample;
    if (is_interactive(options))
        result.preferences = preferences_file();
    result.wake = [&surface] { surface.wake(); };
    return result;
}

/// Runs the viewer with a script. Returns 0, or exit_bad_input after a message on stderr.
int play(std::vector<ScriptStep> steps, const ViewOptions& options, Surface& surface, Viewer& viewer,
         FrameDuties& duties) {
    const auto screenshot = [&](const std::filesystem::path& file) {
        const ScreenPixels screen = read_screen(surface.pixels());
        write_png(file, screen.size, screen.rgb);
    };
    ScriptPlayer player(std::move(steps), options.script.string(), viewer, {print_line, screenshot});
    try {
        surface.run(viewer, {[&](double seconds) { player.before_frame(seconds); },
                             [&] {
                                 player.after_frame();
                                 if (player.wants_frame())
                                     surface.wake();
                                 return duties.after_frame();
                             },
                             interrupted,
                             {}});
    } catch (const ScriptError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return exit_bad_input;
    }
    return duties.exit_code();
}

/// Returns the exit code: view_interrupted if a signal ended a script or a screenshot.
int exit_code(const ViewOptions& options, int code) {
    return interrupted() && !is_interactive(options) ? view_interrupted : code;
}

} // namespace

int run_view(const ViewOptions& options) {
    const WallClock::time_point start = WallClock::now();
    std::vector<ScriptStep> steps;
    try {
        if (!options.script.empty())
            steps = read_script(options.script);
    } catch (const ScriptError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return exit_bad_input;
    }
    const std::unique_ptr<Surface> surface = open_surface(options);
    if (!surface)
        return view_needs_display;
    Session session(most_panes, options.threads, [&] { surface->wake(); });
    Viewer viewer(session, viewer_options(options, *surface));
    viewer.load(options.scene.name, options.scene.loader, options.scene.source);
    FrameDuties duties(options, *surface, viewer, start);
    const InterruptGuard guard;
    if (!steps.empty())
        return exit_code(options, play(std::move(steps), options, *surface, viewer, duties));
    surface->run(viewer, {{}, [&] { return duties.after_frame(); }, interrupted, [&] { viewer.remember(); }});
    return exit_code(options, duties.exit_code());
}

} // namespace tessera
