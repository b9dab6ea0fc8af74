#pragma once

#include "ui/controls.h"
#include "ui/picture_frame.h"
#include "ui/showing.h"
#include "ui/viewer_state.h"

#include <string>

namespace tessera {

/// What pane views draw with.
struct PaneTools {
    const CanvasShader& shader;
    const PaneImages& images;
    Controls& controls;
    ViewerState& state;
};

/// Draws one pane: a strip with its method and buffer, the picture, and a status line. Keeps the renditions of
/// what it shows.
class PaneView {
public:
    /// Changes the state by the controls, and by the mouse over the picture.
    void draw(int index, const ScreenRect& where, PaneTools& tools);

    const Canvas& canvas() const { return canvas_; } ///< of the whole picture, or what is left of a wipe's line

private:
    /// What the mouse took hold of when its button went down.
    enum class Grip { camera, wipe, legend_low, legend_high };

    void draw_picture(int index, const std::string& id, PaneTools& tools);
    PictureFrame place_picture(int index, const std::string& id, PaneTools& tools);
    static void frame_tile(int index, const PictureFrame& frame, ViewerState& state);
    void use_mouse(int index, PictureFrame& frame, PaneTools& tools);
    static void choose_sample(int index, const PictureFrame& frame, ViewerState& state);
    Grip grip_at(int index, const PictureFrame& frame, PaneTools& tools) const;
    void drag(int index, const PictureFrame& frame, float by, PaneTools& tools) const;
    void draw_renditions(int index, const PictureFrame& frame, PaneTools& tools);
    void draw_overlays(int index, const std::string& id, const PictureFrame& frame, PaneTools& tools);
    static void draw_shared(int index, const PictureFrame& frame, const ViewerState& state);
    void draw_magnifier_at_cursor(int index, const PictureFrame& frame, PaneTools& tools);

    Canvas canvas_;
    Canvas right_canvas_; // beyond a wipe's line
    Canvas magnifier_canvas_;
    Grip grip_ = Grip::camera;
    ScreenRect legend_; // its colours, as last drawn
};

} // namespace tessera
