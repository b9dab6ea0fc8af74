#pragma once

#include "render/load/load_progress.h"
#include "ui/gl/controls.h"
#include "ui/gl/image_view.h"
#include "ui/state/viewer_state.h"

#include <imgui.h>

namespace tessera {

/// The windows around the pictures. Each is drawn into the current Dear ImGui frame and changes the state only.

/// The menus of all actions, across the top; returns its height, screen units.
float draw_menu_bar(Controls& controls, ViewerState& state);

/// Draws the settings of the active pane (of all, when linked), of the picture and its size.
void draw_settings_panel(const ScreenRect& where, Controls& controls, ViewerState& state);

/// The edge between `pictures` and the panels to their right, which the mouse can drag.
void draw_panel_edge(const ScreenRect& pictures, Controls& controls, ViewerState& state);

/// What the render on show in the active pane has counted.
void draw_statistics_panel(const ScreenRect& where, Controls& controls, const ViewerState& state);

/// What a reference is to be made of, or how far its making is; over everything.
void draw_reference_dialog(glm::vec2 screen, Controls& controls, ViewerState& state);

/// Which sample the path inspector is to open; over everything.
void draw_sample_dialog(glm::vec2 screen, Controls& controls, ViewerState& state);

/// The messages, newest last; over the pictures, whose size must not depend on them.
void draw_message_panel(const ScreenRect& where, Controls& controls, ViewerState& state);

/// Draws all actions and gestures, over everything.
void draw_help(glm::vec2 screen, Controls& controls, ViewerState& state);

/// What is being loaded and how far that is, over the pictures, and a button to give it up.
void draw_loading(const ScreenRect& where, Controls& controls, ViewerState& state, const std::string& what,
                  const LoadProgress::State& progress, double seconds);

} // namespace tessera
