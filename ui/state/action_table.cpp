#include "ui/state/actions.h"

#include <iterator>
#include <string_view>

namespace tessera {

namespace {

constexpr Shortcut key(Key k) {
    return {k, false, false, 0};
}
constexpr Shortcut ctrl(Key k) {
    return {k, true, false, 0};
}
constexpr Shortcut shift(Key k) {
    return {k, false, true, 0};
}
constexpr Shortcut ctrl_shift(Key k) {
    return {k, true, true, 0};
}
constexpr Shortcut character(char c) {
    return {Key::none, false, false, c};
}
constexpr Shortcut no_shortcut{};

using State = ViewerState;

constexpr Action table[] = {
    {"File", "Open scene ...", "Chooses a Mitsuba scene, an .xml file.", ctrl(Key::o), no_shortcut,
     [](State& s) { s.layout.choosing = FilePurpose::scene; }, nullptr},
    {"File", "Gallery", "Scenes to begin with: the built-in one, recent ones, and those on which methods fail.",
     ctrl(Key::g), no_shortcut, [](State& s) { s.layout.show_gallery = !s.layout.show_gallery; },
     [](const State& s) { return s.layout.show_gallery; }},
    {"File", "Reload", "Reads the scene file again; a camera that was moved stays, and all settings do.",
     key(Key::f5), no_shortcut, [](State& s) { s.wishes.reload = true; }, nullptr},
    {"File", "Open reference ...", "Chooses an EXR file to measure errors against.", ctrl(Key::r), no_shortcut,
     [](State& s) { s.layout.choosing = FilePurpose::reference; }, nullptr},
    {"File", "Make reference ...",
     "Renders a reference of what the panes show, in the background; after an end it goes on from its checkpoint.",
     ctrl(Key::m), no_shortcut, [](State& s) { s.reference_making.show = true; }, nullptr},
    {"File", "Load settings ...", "Chooses settings or a camera that was saved, a .json file.", ctrl(Key::l),
     no_shortcut, [](State& s) { s.layout.choosing = FilePurpose::settings; }, nullptr},
    {"File", "Follow a folder ...",
     "Chooses the folder in which a bench, a sweep or the stability suite is at work, on this machine or on many: "
     "its jobs and curves, as they come.",
     ctrl_shift(Key::o), no_shortcut, [](State& s) { s.layout.choosing = FilePurpose::jobs; }, nullptr},
    {"File", "Save ...",
     "Saves picture, buffers, window, charts, settings or camera, under a name and in a folder.", ctrl(Key::s),
     no_shortcut, [](State& s) { s.layout.choosing = FilePurpose::save; }, nullptr},
    {"File", "Save window", "Writes what the window shows to a PNG file in the folder where was saved last.",
     key(Key::f12), no_shortcut, [](State& s) { s.save(SaveKind::window); }, nullptr},
    {"File", "Save picture",
     "Writes the active pane's buffer, a pixel for each of its pixels and in the colours on show, to a PNG file "
     "in "
     "the folder where was saved last.",
     ctrl_shift(Key::s), no_shortcut, [](State& s) { s.save(SaveKind::picture); }, nullptr},
    {"File", "Save as EXR",
     "Writes the active pane's picture with all its buffers, first hits, errors to the reference, camera and "
     "settings to an EXR file in the folder where was saved last.",
     ctrl(Key::e), no_shortcut, [](State& s) { s.save(SaveKind::exr); }, nullptr},
    {"File", "Save settings",
     "Writes panes, camera, size, display and what is inspected to a JSON file in the folder where was saved "
     "last.",
     ctrl(Key::p), no_shortcut, [](State& s) { s.save(SaveKind::settings); }, nullptr},
    {"File", "Save charts",
     "Writes the chart on show as SVG and as a picture, PNG, and all points and the histogram as CSV, to the "
     "folder where was saved last.",
     key(Key::z), no_shortcut, [](State& s) { s.save(SaveKind::charts); }, nullptr},
    {"File", "Quit", "Ends the program.", ctrl(Key::q), no_shortcut, [](State& s) { s.wishes.quit = true; },
     nullptr},

    {"Edit", "Undo", "Takes back the last change of settings, panes, exposure or camera.", ctrl(Key::z),
     no_shortcut, [](State& s) { s.history.undo(s); }, nullptr},
    {"Edit", "Redo", "Makes again what was taken back.", ctrl_shift(Key::z), ctrl(Key::y),
     [](State& s) { s.history.redo(s); }, nullptr},
    {"Edit", "Find a command ...", "The list of all commands, to be found by words.", ctrl_shift(Key::p),
     no_shortcut, [](State& s) { s.layout.show_palette = !s.layout.show_palette; },
     [](const State& s) { return s.layout.show_palette; }},

    {"Render", "Pause", "Stops and resumes the rendering; what is on show stays.", key(Key::space), no_shortcut,
     [](State& s) { s.rendering.paused = !s.rendering.paused; },
     [](const State& s) { return s.rendering.paused; }},
    {"Render", "Step one pass", "Pauses, and adds one sample a pixel in every pane.", character('.'), no_shortcut,
     step_pass, nullptr},
    {"Render", "Restart", "Renders all panes anew from the first sample.", key(Key::r), no_shortcut,
     [](State& s) { s.wishes.restart = true; }, nullptr},
    {"Render", "Next method", "The next method in the active pane.", key(Key::m), no_shortcut,
     [](State& s) { step_method(s, 1); }, nullptr},
    {"Render", "Previous method", "The previous method in the active pane.", shift(Key::m), no_shortcut,
     [](State& s) { step_method(s, -1); }, nullptr},
    {"Render", "Denoise", "Switches the active pane between raw samples and the denoiser of its method.",
     ctrl(Key::d), no_shortcut, [](State& s) { toggle_denoiser(s, s.active_pane); },
     [](const State& s) { return denoises(applied_norm(s.active().settings)); }},
    {"Render", "Larger tile", "Lets a path be reused by more pixels.", character(']'), no_shortcut,
     [](State& s) { step_tile(s, 1); }, nullptr},
    {"Render", "Smaller tile", "Lets a path be reused by fewer pixels.", character('['), no_shortcut,
     [](State& s) { step_tile(s, -1); }, nullptr},

    {"Buffer", "Reconstruction", "Shows the reconstructed picture in all panes.", key(Key::digit1), no_shortcut,
     show_buffer<Buffer::reconstruction>, shows_buffer<Buffer::reconstruction>},
    {"Buffer", "Primal", "Shows the picture before reconstruction in all panes.", key(Key::digit2), no_shortcut,
     show_buffer<Buffer::primal>, shows_buffer<Buffer::primal>},
    {"Buffer", "Gradient dx", "Shows the differences between a pixel and its right neighbour in all panes.",
     key(Key::digit3), no_shortcut, show_buffer<Buffer::dx>, shows_buffer<Buffer::dx>},
    {"Buffer", "Gradient dy", "Shows the differences between a pixel and the one below in all panes.",
     key(Key::digit4), no_shortcut, show_buffer<Buffer::dy>, shows_buffer<Buffer::dy>},
    {"Buffer", "Reuse count", "Shows how many paths of other pixels brought light to each pixel, in all panes.",
     key(Key::digit5), no_shortcut, show_buffer<Buffer::reused>, shows_buffer<Buffer::reused>},
    {"Buffer", "Shift outcomes", "Shows how the shifts of paths to each pixel ended, in all panes.",
     key(Key::digit6), no_shortcut, show_buffer<Buffer::outcomes>, shows_buffer<Buffer::outcomes>},
    {"Buffer", "Error: relMSE", "Shows (I - r)^2 / (r^2 + 0.001) to the reference r, in all panes.",
     key(Key::digit7), no_shortcut, show_buffer<Buffer::error_relative_squared>,
     shows_buffer<Buffer::error_relative_squared>},
    {"Buffer", "Reference", "Shows the picture that errors are measured against, in all panes.", key(Key::digit8),
     no_shortcut, show_buffer<Buffer::reference>, shows_buffer<Buffer::reference>},

    {"More buffers", "Roulette survival",
     "Shows which share of each pixel's base paths with light the roulette let be reused, in all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::survival>, shows_buffer<Buffer::survival>},
    {"More buffers", "Very direct", "Shows the emission that the camera itself sees, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::very_direct>, shows_buffer<Buffer::very_direct>},
    {"More buffers", "Error: squared", "Shows (I - r)^2 to the reference r, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::error_squared>, shows_buffer<Buffer::error_squared>},
    {"More buffers", "Error: absolute", "Shows |I - r| to the reference r, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::error_absolute>, shows_buffer<Buffer::error_absolute>},
    {"More buffers", "Error: relative", "Shows |I - r| / (|r| + 0.01) to the reference r, in all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::error_relative>, shows_buffer<Buffer::error_relative>},
    {"More buffers", "Albedo", "Shows how much light the surfaces scatter, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::albedo>, shows_buffer<Buffer::albedo>},
    {"More buffers", "Normal", "Shows where the surfaces face, in all panes.", no_shortcut, no_shortcut,
     show_buffer<Buffer::normal>, shows_buffer<Buffer::normal>},
    {"More buffers", "Depth", "Shows how far from the camera the surfaces are, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::depth>, shows_buffer<Buffer::depth>},
    {"More buffers", "Footprint at x1",
     "Shows how wide what a path stands for is where it is first seen, in all panes.", no_shortcut, no_shortcut,
     show_buffer<Buffer::footprint_1>, shows_buffer<Buffer::footprint_1>},
    {"More buffers", "Footprint at x2",
     "Shows how wide what a path stands for is at its second vertex, in all panes.", no_shortcut, no_shortcut,
     show_buffer<Buffer::footprint_2>, shows_buffer<Buffer::footprint_2>},
    {"More buffers", "Variance of primal", "Shows how uncertain the primal still is, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::primal_variance>, shows_buffer<Buffer::primal_variance>},
    {"More buffers", "Variance of dx", "Shows how uncertain the gradients dx still are, in all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::dx_variance>, shows_buffer<Buffer::dx_variance>},
    {"More buffers", "Variance of dy", "Shows how uncertain the gradients dy still are, in all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::dy_variance>, shows_buffer<Buffer::dy_variance>},
    {"More buffers", "Coefficient", "Shows the light over the albedo, of which the picture is made, in all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::coefficient>, shows_buffer<Buffer::coefficient>},
    {"More buffers", "Mean albedo", "Shows the albedo of many points of each pixel, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::mean_albedo>, shows_buffer<Buffer::mean_albedo>},
    {"More buffers", "Sampled albedo", "Shows the albedo that samples were divided by, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::sampled_albedo>, shows_buffer<Buffer::sampled_albedo>},
    {"More buffers", "Covariance term",
     "Shows where albedo and light change together within pixels, in all panes.", no_shortcut, no_shortcut,
     show_buffer<Buffer::covariance>, shows_buffer<Buffer::covariance>},
    {"More buffers", "Projection", "Shows how much of a part of the light the surfaces scatter, in all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::projection>, shows_buffer<Buffer::projection>},
    {"More buffers", "Redistributed fireflies",
     "Shows the radiance that firefly suppression redistributes to other pixels, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::redistributed>, shows_buffer<Buffer::redistributed>},
    {"More buffers", "Reuse set size", "Shows the size of each pixel's reuse set, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::reuse_set_size>, shows_buffer<Buffer::reuse_set_size>},
    {"More buffers", "Gain of sharing", "Shows what sharing brings for its cost, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::gain>, shows_buffer<Buffer::gain>},
    {"More buffers", "Samples", "Shows how many paths of its own each pixel has taken, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::samples>, shows_buffer<Buffer::samples>},
    {"More buffers", "Next part",
     "Shows the next part of coefficients and gradients, or the whole after the last.", no_shortcut, no_shortcut,
     next_part, nullptr},

    {"View", "Brighter", "Exposure up by half a stop.", character('+'), character('='),
     [](State& s) { step_exposure(s, 0.5f); }, nullptr},
    {"View", "Darker", "Exposure down by half a stop.", character('-'), no_shortcut,
     [](State& s) { step_exposure(s, -0.5f); }, nullptr},
    {"View", "Reset exposure", "Exposure back to 0 stops, of differences, too.", key(Key::digit0), no_shortcut,
     [](State& s) { s.display.tone.exposure = s.display.tone.difference_exposure = 0; }, nullptr},
    {"View", "Automatic exposure",
     "The exposure that shows the active pane's picture, or the slow motion's tile; of gradients and differences "
     "their own, and of false colours the range.",
     key(Key::f6), no_shortcut, [](State& s) { s.wishes.auto_exposure = true; }, nullptr},
    {"View", "Next tone curve", "sRGB or filmic: how radiance becomes brightness.", key(Key::y), no_shortcut,
     next_tone, nullptr},
    {"View", "Mark negative values",
     "Shows pixels with a negative red, green or blue in blue. NaN is always magenta, infinity cyan.", key(Key::u),
     no_shortcut, [](State& s) { s.display.mark_negative = !s.display.mark_negative; },
     [](const State& s) { return s.display.mark_negative; }},
    {"View", "Magnifier", "Enlarges the pixels around the mouse, in all panes.", key(Key::l), no_shortcut,
     [](State& s) { s.display.magnifier = !s.display.magnifier; },
     [](const State& s) { return s.display.magnifier; }},
    {"View", "Tiles",
     "Draws over the pictures which pixels share their paths in the newest pass, and marks those of the pixel "
     "under "
     "the mouse; the border of a G-PR tile is orange, and so are the outlines of other sets that have the pixel.",
     key(Key::x), no_shortcut, [](State& s) { s.display.show_tiles = !s.display.show_tiles; },
     [](const State& s) { return s.display.show_tiles; }},
    {"View", "Path inspector",
     "The left button chooses a pixel: its base path and the shifts of its tile are drawn over the picture, and "
     "listed.",
     key(Key::i), no_shortcut, toggle_inspector, [](const State& s) { return s.inspector.active; }},
    {"View", "Inspect a sample ...",
     "Opens a sample of the active pane in the path inspector, by pixel, pass and seed, as a message gives it.",
     ctrl(Key::i), no_shortcut, open_sample_form, nullptr},
    {"View", "Slow motion",
     "Draws one tile of the active pane's newest pass, its base paths one after the other, with the pixels that "
     "each "
     "reaches; the left button chooses a tile.",
     key(Key::j), no_shortcut, toggle_slow_motion, [](const State& s) { return s.slow_motion.active; }},
    {"View", "Fit picture", "Shows the whole picture: undoes zooming and panning.", key(Key::f), no_shortcut,
     [](State& s) { s.set_view({}); }, nullptr},
    {"View", "Light theme", "Dark text on light panels, or the other way round.", key(Key::f9), no_shortcut,
     [](State& s) { s.layout.theme = s.layout.theme == Theme::dark ? Theme::light : Theme::dark; },
     [](const State& s) { return s.layout.theme == Theme::light; }},
    {"View", "Larger text", "Text and controls a quarter larger, up to 300 %.", ctrl(Key::up), no_shortcut,
     [](State& s) { step_ui_scale(s, 0.25f); }, nullptr},
    {"View", "Smaller text", "Text and controls a quarter smaller, down to 100 %.", ctrl(Key::down), no_shortcut,
     [](State& s) { step_ui_scale(s, -0.25f); }, nullptr},
    {"View", "Text as the display says", "Text and controls at the scale of the display.", ctrl(Key::digit0),
     no_shortcut, [](State& s) { s.layout.text_factor = 1; },
     [](const State& s) { return s.layout.text_factor == 1; }},
    {"View", "Settings", "Shows or hides the settings.", key(Key::p), no_shortcut,
     [](State& s) { s.layout.show_panel = !s.layout.show_panel; },
     [](const State& s) { return s.layout.show_panel; }},
    {"View", "Statistics", "Shows or hides what the active pane's render has counted: rays, reuse, shifts.",
     key(Key::t), no_shortcut, [](State& s) { s.layout.show_statistics = !s.layout.show_statistics; },
     [](const State& s) { return s.layout.show_statistics; }},
    {"View", "Charts", "Shows or hides how errors fall, efficiency, how shifts end, and a histogram.", key(Key::h),
     no_shortcut, toggle_charts, [](const State& s) { return s.layout.show_charts; }},
    {"View", "Messages", "Shows or hides the messages.", key(Key::f2), no_shortcut,
     [](State& s) { s.layout.show_messages = !s.layout.show_messages; },
     [](const State& s) { return s.layout.show_messages; }},

    {"View", "Followed folder", "Shows or hides the jobs and curves of the folder that is followed.",
     ctrl_shift(Key::f), no_shortcut, [](State& s) { s.layout.show_jobs = !s.layout.show_jobs; },
     [](const State& s) { return s.layout.show_jobs; }},

    {"Slow motion", "Hold slow motion", "Stops the slow motion where it is, or lets it go on.", shift(Key::space),
     no_shortcut, [](State& s) { s.slow_motion.held = !s.slow_motion.held; },
     [](const State& s) { return s.slow_motion.held; }},
    {"Slow motion", "Next base path", "The slow motion takes one step, and waits.", character('>'), no_shortcut,
     [](State& s) { s.slow_motion.step(1); }, nullptr},
    {"Slow motion", "Previous base path", "The slow motion takes one step back, and waits.", character('<'),
     no_shortcut, [](State& s) { s.slow_motion.step(-1); }, nullptr},
    {"Slow motion", "Next tile", "The slow motion goes on with the next tile, of the newest pass.", shift(Key::j),
     no_shortcut, next_tile, nullptr},

    {"Panes", "One pane", "Renders the active pane only.", ctrl(Key::digit1), no_shortcut, set_panes<1>,
     has_panes<1>},
    {"Panes", "Two panes", "Renders two panes, as their pictures are larger.", ctrl(Key::digit2), no_shortcut,
     set_panes<2>, has_panes<2>},
    {"Panes", "Four panes", "Renders four panes: PT and PR above G-PT and G-PR.", ctrl(Key::digit4), no_shortcut,
     set_panes<4>, has_panes<4>},
    {"Panes", "Next grid", "One, two, four panes, in turn.", key(Key::g), no_shortcut, next_grid, nullptr},
    {"Panes", "Compare reconstructions",
     "One render in four panes: its primal, and the pictures that L1, weighted and guided make of the same "
     "samples.",
     shift(Key::g), no_shortcut, compare_reconstructions, nullptr},
    {"Panes", "Next pane", "Makes the next pane the active one.", key(Key::tab), no_shortcut, next_pane, nullptr},
    {"Panes", "Only the active pane", "Gives it all the room; the others go on rendering.", key(Key::o),
     no_shortcut, [](State& s) { s.layout.alone = !s.layout.alone; },
     [](const State& s) { return s.layout.alone; }},
    {"Panes", "Wipe",
     "Divides the active pane by a line that can be dragged: its own picture to the left, another pane's to the "
     "right.",
     key(Key::v), no_shortcut, toggle<Comparison::Kind::wipe>, compares<Comparison::Kind::wipe>},
    {"Panes", "Difference",
     "Shows the active pane's picture minus another pane's: orange above zero, blue below; exposure enlarges it.",
     key(Key::n), no_shortcut, toggle<Comparison::Kind::difference>, compares<Comparison::Kind::difference>},

    {"Camera", "Reset camera", "Back to the camera of the scene file.", key(Key::home), key(Key::c),
     [](State& s) { s.camera.go_home(); }, nullptr},
    {"Camera", "Bookmark this view", "Keeps the camera, to come back to; saved with the settings.", shift(Key::f7),
     no_shortcut, add_bookmark, nullptr},
    {"Camera", "Next bookmark", "Goes to the next view that was kept.", key(Key::f7), no_shortcut, next_bookmark,
     nullptr},
    {"Camera", "Forget bookmark", "Forgets the view that was gone to or kept last.", ctrl(Key::f7), no_shortcut,
     forget_bookmark, nullptr},
    {"Camera", "Save camera",
     "Writes the camera to NAME-camera.json in the folder where was saved last; to be read by --camera, or "
     "dropped "
     "on the window.",
     key(Key::k), no_shortcut, [](State& s) { s.save(SaveKind::camera); }, nullptr},
    {"Camera", "Copy camera as XML",
     "Puts what stands for the camera in a Mitsuba <sensor>, such as fov and to_world, on the clipboard.",
     shift(Key::k), no_shortcut, [](State& s) { s.wishes.copy_camera = true; }, nullptr},

    {"Help", "Keys and mouse", "Shows or hides this page.", key(Key::f1), character('?'),
     [](State& s) { s.layout.show_help = !s.layout.show_help; },
     [](const State& s) { return s.layout.show_help; }},
};

} // namespace

bool is_in_menu(const Action& action) {
    const std::string_view group = action.menu;
    return group != "More buffers" && group != "Slow motion";
}

std::span<const Action> actions() {
    return table;
}

} // namespace tessera
