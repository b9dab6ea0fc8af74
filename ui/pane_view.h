#pragma once

#include "ui/canvas.h"
#include "ui/controls.h"
#include "ui/panels.h"
#include "ui/viewer_state.h"

#include <string>

namespace tessera {

/// Draws one pane: a strip with its method and buffer, the picture, and a status line. Keeps what it has on the
/// graphics side, and uploads a picture only when another one is to be shown.
class PaneView {
public:
    /// Changes the state by the controls, and by the mouse over the picture.
    void draw(int index, const ScreenRect& where, const CanvasShader& shader, Controls& controls,
              ViewerState& state);

    int uploads() const { return uploads_; }
    const Canvas& canvas() const { return canvas_; }

private:
    void draw_header(const std::string& id, Controls& controls, PaneState& pane);
    void draw_picture(int index, const std::string& id, const CanvasShader& shader, Controls& controls,
                      ViewerState& state);
    void upload(const PaneState& pane);

    Canvas canvas_;
    RgbImage scratch_;
    std::shared_ptr<const void> shown_; // what the canvas holds a picture of, kept so that it stays unique
    Buffer shown_buffer_ = Buffer::reconstruction;
    float top_ = 1; // of the false colours
    int uploads_ = 0;
};

/// The line below a picture: method, samples a pixel, seconds, rays a second, reconstruction.
std::string status_text(const PaneState& pane, bool paused, int spp_limit);

} // namespace tessera
