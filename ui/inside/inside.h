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

/// What the small view of paths in space shows.
struct SpaceSubject {
    const std::vector<InspectedVertex>& path;
    std::vector<const InspectedShift*> shifts;
    int marked = -1; ///< the shift that stands out
    float scene_radius = 1;
};

/// Draws the subject into the current window, where the cursor is, as an item "space": a drag turns it, a drag
/// with Shift or the middle button moves it, the wheel comes nearer, a double click shows the whole path.
void draw_space_view(glm::vec2 size, const SpaceSubject& subject, SpaceView& view, Controls& controls);

/// The shifts of an inspection that its direction selects for show.
std::vector<const InspectedShift*> shown_shifts(const Inspector& inspector);

/// Draws the inspected sample over the picture of its pane: the base path in white, light samples in yellow, and
/// the shifts that are shown, in the colours of their outcomes, as the pixels that they come from or go to are;
/// the sampling set has a line around it, its border another. In other panes the pixel alone is marked. To be
/// called within the pane's window.
void draw_inspected_paths(const PictureFrame& frame, const ScreenRect& clip, int pane, const ViewerState& state);

/// Lists the vertices of the base path, or of the shift whose row is chosen; `width` in screen units.
void draw_vertex_table(const Inspector& inspector, float width, Controls& controls);

/// Lists the shifts on show, a row each. The one under the mouse is marked, a click chooses.
void draw_shift_table(Inspector& inspector, float width, Controls& controls);

/// Radiance as a luminance, and numbers, in four digits.
std::string short_text(const Rgb& value);
std::string short_text(float value);
/// "12, 34".
std::string short_text(glm::ivec2 pixel);

/// Whether the slow motion has a tile to show.
bool has_slow_motion(const ViewerState& state);
/// Whether the tile of the slow motion is this pane's.
bool shows_slow_motion(int pane, const ViewerState& state);

/// What each pixel of the slow motion's tile, which must be there, has got once all base paths have arrived.
std::vector<float> slow_motion_luminances(const SlowMotion& slow);

/// Draws the tile over the picture of its pane: its parts, the sampling set at hand with its border, what every
/// pixel has got so far, and arrows from the base path that arrives to the pixels that it is shifted to, in the
/// colours of their outcomes. To be called within the pane's window.
void draw_slow_motion(const PictureFrame& frame, const ScreenRect& clip, int pane, const ViewerState& state);

/// The vertices and shifts of the sample that is looked at; over the pictures.
void draw_inspector_panel(const ScreenRect& where, Controls& controls, ViewerState& state);

/// The slow motion's controls, and what is happening; over the pictures.
void draw_slow_motion_panel(const ScreenRect& where, Controls& controls, ViewerState& state);

} // namespace tessera
