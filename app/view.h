#pragma once

#include "ui/render_size.h"
#include "ui/scene_load.h"
#include "ui/viewer_state.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// What run_view returns where there is neither a display nor a way to draw without one: the caller may render the
/// same comparison headless.
inline constexpr int view_needs_display = -1;
/// What it returns where a signal ended a script or a screenshot: as of Ctrl-C in a shell.
inline constexpr int view_cut_short = 130;

/// `tessera view`.
struct ViewOptions {
    SceneOrigin scene; ///< loaded in the background
    SceneOpener open;  ///< for scenes dropped on the window
    std::vector<PaneSettings> panes = default_panes(2);
    bool panes_as_remembered = true; ///< as many as the last time; otherwise, or if that is not known, `panes`
    std::optional<int> max_depth;    ///< otherwise the scene decides
    SizeChoice render_size;
    int threads = 0;                       ///< of the renderer; 0: one a hardware thread
    std::optional<glm::ivec2> window_size; ///< otherwise that of the last window, or 1440x810
    float ui_scale = 0;                    ///< of text and controls; 0: as the display says
    int spp = 0;                           ///< samples a pixel at which the panes rest; 0: none (a screenshot: 16)
    std::optional<SampleChoice> sample;    ///< to begin with in the path inspector, of the last pane
    bool show_panel = true;
    std::filesystem::path reference;  ///< EXR file to measure errors against; empty: none
    std::filesystem::path screenshot; ///< if not empty: save a picture of the window at `spp` samples, and end
    std::filesystem::path script;     ///< if not empty: steps to be played
    bool log_actions = false;         ///< a line on stdout for every change of state, and where controls lie
};

/// Opens the viewer and returns when the user quits: an exit code (0; 2: the scene or the picture failed, a
/// message is on stderr), or one of those above. Where the display is lost, the process ends: display_lost.
int run_view(const ViewOptions& options);

} // namespace tessera
