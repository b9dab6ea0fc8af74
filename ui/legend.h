#pragma once

#include "ui/buffer.h"
#include "ui/controls.h"
#include "ui/screen_rect.h"

#include <string>
#include <vector>

namespace tessera {

/// What colours stand for, in words and in a bar of them, evenly spaced.
struct Legend {
    std::string text;
    std::string help;
    std::vector<glm::vec3> colours; ///< empty: there is no bar
};

/// Of a buffer's false colours. Its bar is for dragging.
Legend false_colour_legend(Buffer buffer, const ValueRange& range);
/// Of +/- colours at an exposure, stops. `about` and `scale`: what the numbers are, and what they are shown times.
Legend signed_legend(const std::string& about, const std::string& unit, float scale, float exposure);

/// Draws a legend in a lower corner of a picture if there is room: the left one, or the right. Noted as `id`. To
/// be called after the item that the picture is. Returns the bar of colours, which is empty if nothing was drawn.
ScreenRect draw_legend(const ScreenRect& picture, const std::string& id, const Legend& legend, bool at_right,
                       Controls& controls);

} // namespace tessera
