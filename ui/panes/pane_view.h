#pragma once

#include "ui/gl/image_view.h"
#include "ui/panes/legend.h"

#include <string>

namespace tessera {

/// Draws a pane: header with method and buffer, picture, and status line. Owns the canvases of the picture.
class PaneView {
public:
    /// Draws the header, and applies its controls and the mouse to the state. To be called for all panes before
    /// draw(), so that all pictures show the change in the same frame.
    void take_input(int index, const ScreenRect& where, PaneTools& tools);
    /// Draws the picture and the status line.
    void draw(int index, PaneTools& tools);

    const Canvas& canvas() const { return canvas_; } ///< of the picture, or of the left side of a wipe

private:
    /// The object that a drag moves: a wipe's line or a range, otherwise the camera.
    struct Grip {
        std::optional<float> wipe; ///< distance of the mouse from the line at the start, screen units
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
    Canvas right_canvas_; // of the right side of a wipe
    Canvas magnifier_canvas_;
    PaneLegends legends_;
    PictureFrame frame_; // of the present frame
    Grip grip_;
    bool has_hold_ = false;  // the present drag has grabbed the point under the mouse
    bool is_double_ = false; // the present press is a double click on the camera
    bool has_moved_ = false; // the mouse has moved since the press
};

} // namespace tessera
