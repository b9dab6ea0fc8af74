#pragma once

#include "ui/gl/canvas.h"
#include "ui/gl/controls.h"
#include "ui/gl/gl.h"
#include "ui/panes/pane_view.h"
#include "ui/panes/showing.h"
#include "ui/state/viewer_state.h"

#include <array>

namespace tessera {

/// Area of the window that shows the panes.
class PictureArea {
public:
    /// Draws the visible panes, and applies the input of their controls and of the mouse to the state.
    void draw(const ScreenRect& where, Controls& controls, ViewerState& state);

    /// Sets the exposure, or the range of false colours, from the pixels that the active pane shows.
    void expose(ViewerState& state) const;

    /// Returns the active pane's picture at the image's resolution. Empty: there is no picture yet.
    ScreenPixels active_picture(const ViewerState& state) const {
        return view_picture(state.active_pane, shader_, images_, state);
    }

    const PaneView& view(int pane) const { return views_[pane]; }
    const PaneImages& images() const { return images_; } ///< index: pane or the_reference
    const PaneImage& image(int pane) const { return images_[pane]; }

private:
    void take_images(const ViewerState& state);

    CanvasShader shader_;
    PaneImages images_;
    std::array<PaneView, most_panes> views_;
};

} // namespace tessera
