#pragma once

#include "render/inspect/inspection.h"
#include "ui/gl/controls.h"
#include "ui/gl/image_view.h"
#include "ui/inside/drawing.h"
#include "ui/state/camera_control.h"
#include "ui/state/inspected.h"
#include "ui/state/viewer_state.h"

#include <memory>
#include <vector>

namespace tessera {

/// Content of the small 3D view of paths.
struct SpaceSubject {
    const std::vector<InspectedVertex>& path;
    std::vector<const InspectedShift*> shifts;
    int marked = -1; ///< index of the highlighted shift; -1: none
    float scene_radius = 1;
};

/// Draws the 3D view at the cursor of the current window, as an item "space". Dragging rotates it, dragging with
/// Shift or the middle button moves it, the wheel zooms, and a double click shows the whole path.
void draw_space_view(glm::vec2 size, const SpaceSubject& subject, SpaceView& view, Controls& controls);

/// Returns the shifts of an inspection in the chosen direction, brightest first.
std::vector<const InspectedShift*> shown_shifts(const Inspector& inspector);

/// Draws the inspected sample over the picture of its pane: the base path in white, light samples in yellow, and
/// shifts in the colours of their outcomes, as are the pixels that they come from or go to. The sampling set and
/// its border are outlined. In other panes only the pixel is marked. Must be called within the pane's window.
void draw_inspected_paths(const PictureFrame& frame, const ScreenRect& clip, int pane, const ViewerState& state);

/// Draws the table of vertices of the base path, or of the chosen shift; `width` in screen units.
void draw_vertex_table(const Inspector& inspector, float width, Controls& controls);

/// Draws the table of shifts. The row under the mouse is highlighted, and a click chooses it.
void draw_shift_table(Inspector& inspector, float width, Controls& controls);

/// Return the luminance of a radiance, or a number, in four digits.
std::string short_text(const Rgb& value);
std::string short_text(float value);
/// Returns "12, 34".
std::string short_text(glm::ivec2 pixel);

/// Returns whether the slow motion has a tile to show.
bool has_slow_motion(const ViewerState& state);
/// Returns whether the tile of the slow motion belongs to this pane.
bool shows_slow_motion(int pane, const ViewerState& state);

/// Returns the luminance of each pixel of the slow motion's tile after all base paths. The tile must exist.
std::vector<float> slow_motion_luminances(const SlowMotion& slow);

/// Draws the tile over the picture of its pane: its sampling sets, the current set with its border, the radiance
/// of each pixel so far, and arrows from the current base path to the pixels that it is shifted to, in the colours
/// of their outcomes. Must be called within the pane's window.
void draw_slow_motion(const PictureFrame& frame, const ScreenRect& clip, int pane, const ViewerState& state);

/// Draws the path inspector's tables over the pictures.
void draw_inspector_panel(const ScreenRect& where, Controls& controls, ViewerState& state);

/// Draws the slow motion's controls and explanations over the pictures.
void draw_slow_motion_panel(const ScreenRect& where, Controls& controls, ViewerState& state);

} // namespace tessera
