#pragma once

#include "ui/gl/image_view.h"
#include "ui/panes/legend.h"

#include <string>

namespace tessera {

/// Draws one pane: a strip with its method and buffer, the picture, and a status line. Keeps the renditions of
/// what it shows.
class PaneView {
public:
    /// Draws the strip, and changes the state by its controls and by the mouse over the picture. All panes do so
    /// before any draws its picture: what the mouse does over one, all show in the same frame.
    void take_input(int index, const ScreenRect& where, PaneTools& tools);
    /// Draws the rest.
    void draw(int index, PaneTools& tools);

    const Canvas& canvas() const { return canvas_; } ///< of the whole picture, or what is left of a wipe's line

private:
    /// What the mouse takes hold of when its button goes down: the camera, unless it is one of these.
    struct Grip {
        std::optional<float> wipe; ///< how far it is from the line, screen units
        std::optional<HeldRange> range;
        bool is_camera() const { return !wipe && !range; }
    };

    PictureFrame place_picture(int index, const std::string& id, PaneTools& tools);
    static void frame_tile(int index, const PictureFrame& frame, ViewerState& state);
    void use_mouse(int index, PictureFrame& frame, PaneTools& tools);
    void take_hold(const PaneMouse& mouse, const PictureFrame& frame, ViewerState& state);
    static void choose_sample(int index, const PictureFrame& frame, ViewerState& state);
    Grip grip_at(int index, const PictureFrame& frame, PaneTools& tools) const;
    void drag(const PictureFrame& frame, ViewerState& state) const;
    void draw_renditions(int index, const PictureFrame& frame, PaneTools& tools);
    void draw_overlays(int index, const std::string& id, const PictureFrame& frame, PaneTools& tools);
    static void draw_missing(int index, const PictureFrame& frame, const PaneTools& tools);
    static void draw_shared(int index, const PictureFrame& frame, const ViewerState& state);
    static void draw_active_frame(int index, const PictureFrame& frame, const ViewerState& state);
    static void draw_mode(const PictureFrame& frame, const std::string& id, PaneTools& tools);
    void draw_magnifier_at_cursor(int index, const PictureFrame& frame, PaneTools& tools);

    Canvas canvas_;
    Canvas right_canvas_; // beyond a wipe's line
    Canvas magnifier_canvas_;
    PaneLegends legends_;
    PictureFrame frame_; // of this frame
    Grip grip_;
    bool has_hold_ = false;  // of what lay under the mouse when the button went down
    bool is_double_ = false; // it went down for the second time
    bool has_moved_ = false; // the mouse, since then
};

} // namespace tessera
