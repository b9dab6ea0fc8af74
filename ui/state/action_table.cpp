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
    {"File", "Gallery", "Shows scenes to open: the built-in one, recent ones, and scenes on which methods fail.",
     ctrl(Key::g), no_shortcut, [](State& s) { s.layout.show_gallery = !s.layout.show_gallery; },
     [](const State& s) { return s.layout.show_gallery; }},
    {"File", "Reload", "Reads the scene file again. All settings stay, and so does a camera that you moved.",
     key(Key::f5), no_shortcut, [](State& s) { s.wishes.reload = true; }, nullptr},
    {"File", "Open reference ...", "Chooses an EXR file to measure errors against.", ctrl(Key::r), no_shortcut,
     [](State& s) { s.layout.choosing = FilePurpose::reference; }, nullptr},
    {"File", "Make reference ...",
     "Renders a reference for the view of the panes in the background. An interrupted one continues from its "
     "checkpoint.",
     ctrl(Key::m), no_shortcut, [](State& s) { s.reference_making.show = true; }, nullptr},
    {"File", "Load settings ...", "Chooses a .json file with saved settings or a saved camera.", ctrl(Key::l),
     no_shortcut, [](State& s) { s.layout.choosing = FilePurpose::settings; }, nullptr},
    {"File", "Follow a folder ...",
     "Chooses the output folder of a running bench, sweep or stability command, on one or more machines, and "
     "shows its jobs and charts as they progress.",
     ctrl_shift(Key::o), no_shortcut, [](State& s) { s.layout.choosing = FilePurpose::jobs; }, nullptr},
    {"File", "Save ...", "Saves picture, buffers, window, charts, settings or camera to a chosen file.",
     ctrl(Key::s), no_shortcut, [](State& s) { s.layout.choosing = FilePurpose::save; }, nullptr},
    {"File", "Save window", "Writes the window to a PNG file in the folder of the last save.", key(Key::f12),
     no_shortcut, [](State& s) { s.save(SaveKind::window); }, nullptr},
    {"File", "Save picture",
     "Writes the active pane's buffer, pixel by pixel in the displayed colours, to a PNG file in the folder of "
     "the last save.",
     ctrl_shift(Key::s), no_shortcut, [](State& s) { s.save(SaveKind::picture); }, nullptr},
    {"File", "Save as EXR",
     "Writes the active pane's picture with all its buffers, first hits, errors to the reference, camera and "
     "settings to an EXR file in the folder of the last save.",
     ctrl(Key::e), no_shortcut, [](State& s) { s.save(SaveKind::exr); }, nullptr},
    {"File", "Save settings",
     "Writes panes, camera, size, display and the inspected sample to a JSON file in the folder of the last save.",
     ctrl(Key::p), no_shortcut, [](State& s) { s.save(SaveKind::settings); }, nullptr},
    {"File", "Save charts",
     "Writes the current chart as SVG and PNG, and all points and the histogram as CSV, to the folder of the last "
     "save.",
     key(Key::z), no_shortcut, [](State& s) { s.save(SaveKind::charts); }, nullptr},
    {"File", "Quit", "Ends the program.", ctrl(Key::q), no_shortcut, [](State& s) { s.wishes.quit = true; },
     nullptr},

    {"Edit", "Undo", "Reverts the last change of settings, panes, exposure or camera.", ctrl(Key::z), no_shortcut,
     [](State& s) { s.history.undo(s); }, nullptr},
    {"Edit", "Redo", "Repeats the change that Undo reverted.", ctrl_shift(Key::z), ctrl(Key::y),
     [](State& s) { s.history.redo(s); }, nullptr},
    {"Edit", "Find a command ...", "Lists all commands. Type words to filter the list.", ctrl_shift(Key::p),
     no_shortcut, [](State& s) { s.layout.show_palette = !s.layout.show_palette; },
     [](const State& s) { return s.layout.show_palette; }},

    {"Render", "Pause", "Stops or resumes rendering. The pictures stay.", key(Key::space), no_shortcut,
     [](State& s) { s.rendering.paused = !s.rendering.paused; },
     [](const State& s) { return s.rendering.paused; }},
    {"Render", "Step one pass", "Pauses, and adds one sample per pixel in every pane.", character('.'),
     no_shortcut, step_pass, nullptr},
    {"Render", "Restart", "Restarts all panes from the first sample.", key(Key::r), no_shortcut,
     [](State& s) { s.wishes.restart = true; }, nullptr},
    {"Render", "Next method", "Switches the active pane to the next method.", key(Key::m), no_shortcut,
     [](State& s) { step_method(s, 1); }, nullptr},
    {"Render", "Previous method", "Switches the active pane to the previous method.", shift(Key::m), no_shortcut,
     [](State& s) { step_method(s, -1); }, nullptr},
    {"Render", "Denoise", "Switches the active pane between raw samples and the denoiser of its method.",
     ctrl(Key::d), no_shortcut, [](State& s) { toggle_denoiser(s, s.active_pane); },
     [](const State& s) { return denoises(applied_norm(s.active().settings)); }},
    {"Render", "Larger tile", "Reuses each path in more pixels.", character(']'), no_shortcut,
     [](State& s) { step_tile(s, 1); }, nullptr},
    {"Render", "Smaller tile", "Reuses each path in fewer pixels.", character('['), no_shortcut,
     [](State& s) { step_tile(s, -1); }, nullptr},

    {"Buffer", "Result", "Shows the resulting picture in all panes.", key(Key::digit1), no_shortcut,
     show_buffer<Buffer::reconstruction>, shows_buffer<Buffer::reconstruction>},
    {"Buffer", "Primal", "Shows the primal image, without reconstruction, in all panes.", key(Key::digit2),
     no_shortcut, show_buffer<Buffer::primal>, shows_buffer<Buffer::primal>},
    {"Buffer", "Gradient dx", "Shows the differences between a pixel and its right neighbour in all panes.",
     key(Key::digit3), no_shortcut, show_buffer<Buffer::dx>, shows_buffer<Buffer::dx>},
    {"Buffer", "Gradient dy", "Shows the differences between a pixel and the one below in all panes.",
     key(Key::digit4), no_shortcut, show_buffer<Buffer::dy>, shows_buffer<Buffer::dy>},
    {"Buffer", "Reuse count", "Shows how many paths of other pixels contributed to each pixel, in all panes.",
     key(Key::digit5), no_shortcut, show_buffer<Buffer::reused>, shows_buffer<Buffer::reused>},
    {"Buffer", "Shift outcomes", "Shows the outcomes of the shifts to each pixel, in all panes.", key(Key::digit6),
     no_shortcut, show_buffer<Buffer::outcomes>, shows_buffer<Buffer::outcomes>},
    {"Buffer", "Error: relMSE", "Shows (I - r)^2 / (r^2 + 0.001) for picture I and reference r, in all panes.",
     key(Key::digit7), no_shortcut, show_buffer<Buffer::error_relative_squared>,
     shows_buffer<Buffer::error_relative_squared>},
    {"Buffer", "Reference", "Shows the image that errors are measured against, in all panes.", key(Key::digit8),
     no_shortcut, show_buffer<Buffer::reference>, shows_buffer<Buffer::reference>},

    {"More buffers", "Roulette survival",
     "Of each pixel's base paths that carry light, shows the fraction that survives Russian roulette on reuse, in "
     "all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::survival>, shows_buffer<Buffer::survival>},
    {"More buffers", "Directly visible emitters",
     "Shows the emission that the camera sees directly, in all panes.", no_shortcut, no_shortcut,
     show_buffer<Buffer::very_direct>, shows_buffer<Buffer::very_direct>},
    {"More buffers", "Error: squared", "Shows (I - r)^2 for picture I and reference r, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::error_squared>, shows_buffer<Buffer::error_squared>},
    {"More buffers", "Error: absolute", "Shows |I - r| for picture I and reference r, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::error_absolute>, shows_buffer<Buffer::error_absolute>},
    {"More buffers", "Error: relative",
     "Shows |I - r| / (|r| + 0.01) for picture I and reference r, in all panes.", no_shortcut, no_shortcut,
     show_buffer<Buffer::error_relative>, shows_buffer<Buffer::error_relative>},
    {"More buffers", "Albedo", "Shows the albedo of the surfaces seen first, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::albedo>, shows_buffer<Buffer::albedo>},
    {"More buffers", "Normal", "Shows the shading normals of the surfaces seen first, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::normal>, shows_buffer<Buffer::normal>},
    {"More buffers", "Depth", "Shows the distance to the surfaces seen first, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::depth>, shows_buffer<Buffer::depth>},
    {"More buffers", "Footprint at x1", "Shows the width of a path's footprint at its first vertex, in all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::footprint_1>, shows_buffer<Buffer::footprint_1>},
    {"More buffers", "Footprint at x2",
     "Shows the width of a path's footprint at its second vertex, in all panes.", no_shortcut, no_shortcut,
     show_buffer<Buffer::footprint_2>, shows_buffer<Buffer::footprint_2>},
    {"More buffers", "Variance of primal", "Shows the variance of the primal image, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::primal_variance>, shows_buffer<Buffer::primal_variance>},
    {"More buffers", "Variance of dx", "Shows the variance of the gradients dx, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::dx_variance>, shows_buffer<Buffer::dx_variance>},
    {"More buffers", "Variance of dy", "Shows the variance of the gradients dy, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::dy_variance>, shows_buffer<Buffer::dy_variance>},
    {"More buffers", "Coefficient", "Shows the demodulated radiance (radiance over albedo), in all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::coefficient>, shows_buffer<Buffer::coefficient>},
    {"More buffers", "Mean albedo",
     "Shows the mean albedo of each pixel, over at least four points independent of the samples, in all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::mean_albedo>, shows_buffer<Buffer::mean_albedo>},
    {"More buffers", "Sampled albedo", "Shows the mean albedo by which samples were divided, in all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::sampled_albedo>, shows_buffer<Buffer::sampled_albedo>},
    {"More buffers", "Covariance term",
     "Shows the covariance of albedo and demodulated radiance within each pixel, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::covariance>, shows_buffer<Buffer::covariance>},
    {"More buffers", "Projection",
     "Shows the projection of each pixel's scattering on one basis function, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::projection>, shows_buffer<Buffer::projection>},
    {"More buffers", "Redistributed fireflies",
     "Shows the radiance that firefly suppression redistributes to other pixels, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::redistributed>, shows_buffer<Buffer::redistributed>},
    {"More buffers", "Reuse set size", "Shows the size of each pixel's reuse set, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::reuse_set_size>, shows_buffer<Buffer::reuse_set_size>},
    {"More buffers", "Gain of path reuse", "Shows the gain in efficiency by path reuse, in all panes.",
     no_shortcut, no_shortcut, show_buffer<Buffer::gain>, shows_buffer<Buffer::gain>},
    {"More buffers", "Samples", "Shows the number of base paths of each pixel, in all panes.", no_shortcut,
     no_shortcut, show_buffer<Buffer::samples>, shows_buffer<Buffer::samples>},
    {"More buffers", "Next component",
     "Shows the next basis component of coefficients and gradients, or the whole after the last.", no_shortcut,
     no_shortcut, next_component, nullptr},

    {"View", "Brighter", "Increases the exposure by half a stop.", character('+'), character('='),
     [](State& s) { step_exposure(s, 0.5f); }, nullptr},
    {"View", "Darker", "Decreases the exposure by half a stop.", character('-'), no_shortcut,
     [](State& s) { step_exposure(s, -0.5f); }, nullptr},
    {"View", "Reset exposure", "Sets exposure and difference exposure to 0 stops.", key(Key::digit0), no_shortcut,
     [](State& s) { s.display.tone.exposure = s.display.tone.difference_exposure = 0; }, nullptr},
    {"View", "Automatic exposure",
     "Fits the exposure to the active pane's picture, or to the slow motion's tile. For gradients and "
     "differences it fits the difference exposure, for false colours their range.",
     key(Key::f6), no_shortcut, [](State& s) { s.wishes.auto_exposure = true; }, nullptr},
    {"View", "Next tone curve", "Switches between the tone curves sRGB and filmic.", key(Key::y), no_shortcut,
     next_tone, nullptr},
    {"View", "Mark negative values",
     "Shows pixels with a negative component in blue. NaN is always magenta, infinity cyan.", key(Key::u),
     no_shortcut, [](State& s) { s.display.mark_negative = !s.display.mark_negative; },
     [](const State& s) { return s.display.mark_negative; }},
    {"View", "Magnifier", "Enlarges the pixels around the mouse, in all panes.", key(Key::l), no_shortcut,
     [](State& s) { s.display.magnifier = !s.display.magnifier; },
     [](const State& s) { return s.display.magnifier; }},
    {"View", "Tiles",
     "Draws the reuse sets of the newest pass over the pictures, and marks those of the pixel under the mouse. "
     "Orange: the border of its G-PR tile, and the outlines of other sets that contain it.",
     key(Key::x), no_shortcut, [](State& s) { s.display.show_tiles = !s.display.show_tiles; },
     [](const State& s) { return s.display.show_tiles; }},
    {"View", "Path inspector",
     "The left button chooses a pixel. Its base path and the shifts of its tile are drawn over the picture and "
     "listed.",
     key(Key::i), no_shortcut, toggle_inspector, [](const State& s) { return s.inspector.active; }},
    {"View", "Inspect a sample ...",
     "Opens a sample of the active pane in the path inspector by pixel, pass and seed, which messages state.",
     ctrl(Key::i), no_shortcut, open_sample_form, nullptr},
    {"View", "Slow motion",
     "Draws the base paths of one tile of the active pane's newest pass one by one, with their shifts to other "
     "pixels. The left button chooses a tile.",
     key(Key::j), no_shortcut, toggle_slow_motion, [](const State& s) { return s.slow_motion.active; }},
    {"View", "Fit picture", "Shows the whole picture: resets zoom and pan.", key(Key::f), no_shortcut,
     [](State& s) { s.set_view({}); }, nullptr},
    {"View", "Light theme", "Switches between dark text on light panels and light text on dark panels.",
     key(Key::f9), no_shortcut,
     [](State& s) { s.layout.theme = s.layout.theme == Theme::dark ? Theme::light : Theme::dark; },
     [](const State& s) { return s.layout.theme == Theme::light; }},
    {"View", "Larger text", "Enlarges text and controls by 25 percentage points, up to 300 %.", ctrl(Key::up),
     no_shortcut, [](State& s) { step_ui_scale(s, 0.25f); }, nullptr},
    {"View", "Smaller text", "Reduces text and controls by 25 percentage points, down to 100 %.", ctrl(Key::down),
     no_shortcut, [](State& s) { step_ui_scale(s, -0.25f); }, nullptr},
    {"View", "Default text size", "Sets text and controls to the scale of the display.", ctrl(Key::digit0),
     no_shortcut, [](State& s) { s.layout.text_factor = 1; },
     [](const State& s) { return s.layout.text_factor == 1; }},
    {"View", "Settings", "Shows or hides the settings.", key(Key::p), no_shortcut,
     [](State& s) { s.layout.show_panel = !s.layout.show_panel; },
     [](const State& s) { return s.layout.show_panel; }},
    {"View", "Statistics", "Shows or hides the counters of the active pane's render: rays, path reuse, shifts.",
     key(Key::t), no_shortcut, [](State& s) { s.layout.show_statistics = !s.layout.show_statistics; },
     [](const State& s) { return s.layout.show_statistics; }},
    {"View", "Charts", "Shows or hides the charts: error, efficiency, shift outcomes, and a histogram.",
     key(Key::h), no_shortcut, toggle_charts, [](const State& s) { return s.layout.show_charts; }},
    {"View", "Messages", "Shows or hides the messages.", key(Key::f2), no_shortcut,
     [](State& s) { s.layout.show_messages = !s.layout.show_messages; },
     [](const State& s) { return s.layout.show_messages; }},

    {"View", "Followed folder", "Shows or hides the jobs and charts of the followed folder.", ctrl_shift(Key::f),
     no_shortcut, [](State& s) { s.layout.show_jobs = !s.layout.show_jobs; },
     [](const State& s) { return s.layout.show_jobs; }},

    {"Slow motion", "Hold slow motion", "Pauses or resumes the slow motion.", shift(Key::space), no_shortcut,
     [](State& s) { s.slow_motion.held = !s.slow_motion.held; },
     [](const State& s) { return s.slow_motion.held; }},
    {"Slow motion", "Next base path", "Advances the slow motion by one base path, and pauses it.", character('>'),
     no_shortcut, [](State& s) { s.slow_motion.step(1); }, nullptr},
    {"Slow motion", "Previous base path", "Moves the slow motion back by one base path, and pauses it.",
     character('<'), no_shortcut, [](State& s) { s.slow_motion.step(-1); }, nullptr},
    {"Slow motion", "Next tile", "Continues the slow motion with the next tile, in the newest pass.",
     shift(Key::j), no_shortcut, next_tile, nullptr},

    {"Panes", "One pane", "Renders the active pane only.", ctrl(Key::digit1), no_shortcut, set_panes<1>,
     has_panes<1>},
    {"Panes", "Two panes", "Renders two panes, arranged to maximise their pictures.", ctrl(Key::digit2),
     no_shortcut, set_panes<2>, has_panes<2>},
    {"Panes", "Four panes", "Renders four panes: PT and PR above G-PT and G-PR.", ctrl(Key::digit4), no_shortcut,
     set_panes<4>, has_panes<4>},
    {"Panes", "Next grid", "Switches between one, two and four panes.", key(Key::g), no_shortcut, next_grid,
     nullptr},
    {"Panes", "Compare reconstructions",
     "Shows one render in four panes: raw samples, and the L1, weighted and guided reconstructions of the same "
     "samples.",
     shift(Key::g), no_shortcut, compare_reconstructions, nullptr},
    {"Panes", "Next pane", "Makes the next pane active.", key(Key::tab), no_shortcut, next_pane, nullptr},
    {"Panes", "Only the active pane", "Hides the other panes. They continue to render.", key(Key::o), no_shortcut,
     [](State& s) { s.layout.alone = !s.layout.alone; }, [](const State& s) { return s.layout.alone; }},
    {"Panes", "Wipe",
     "Divides the active pane by a line that can be dragged: its own picture is on the left, another pane's on "
     "the right.",
     key(Key::v), no_shortcut, toggle<Comparison::Kind::wipe>, compares<Comparison::Kind::wipe>},
    {"Panes", "Difference",
     "Shows the active pane's picture minus another pane's: orange above zero, blue below. The exposure scales "
     "it.",
     key(Key::n), no_shortcut, toggle<Comparison::Kind::difference>, compares<Comparison::Kind::difference>},

    {"Camera", "Reset camera", "Returns to the camera of the scene file.", key(Key::home), key(Key::c),
     [](State& s) { s.camera.go_home(); }, nullptr},
    {"Camera", "Bookmark this view", "Stores the camera as a bookmark, which is saved with the settings.",
     shift(Key::f7), no_shortcut, add_bookmark, nullptr},
    {"Camera", "Next bookmark", "Moves the camera to the next bookmark.", key(Key::f7), no_shortcut, next_bookmark,
     nullptr},
    {"Camera", "Forget bookmark", "Deletes the bookmark that was visited or added last.", ctrl(Key::f7),
     no_shortcut, forget_bookmark, nullptr},
    {"Camera", "Save camera",
     "Writes the camera to NAME-camera.json in the folder of the last save. The option --camera reads it, and "
     "it can be dropped on the window.",
     key(Key::k), no_shortcut, [](State& s) { s.save(SaveKind::camera); }, nullptr},
    {"Camera", "Copy camera as XML",
     "Copies the camera to the clipboard as properties of a Mitsuba <sensor>, such as fov and to_world.",
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
