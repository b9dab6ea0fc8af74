#pragma once

#include "ui/buffer.h"
#include "ui/controls.h"
#include "ui/screen_rect.h"

#include <string>
#include <vector>

#include <imgui.h>

namespace tessera {

/// What one colour stands for.
struct LegendEntry {
    std::string name;
    ImU32 colour;
};

/// What colours stand for: in words, and in a bar of them or one by one.
struct Legend {
    std::string text;
    std::string help;
    std::vector<glm::vec3> colours; ///< of the bar, evenly spaced; empty: there is none
    std::vector<LegendEntry> entries;
};
inline constexpr float widest_legend = 24; ///< that has entries: in sizes of the font

/// Of a buffer's false colours. Its bar is for dragging.
Legend false_colour_legend(Buffer buffer, const ValueRange& range);
/// Of +/- colours at an exposure, stops. `about` and `scale`: what the numbers are, and what they are shown times.
Legend signed_legend(const std::string& about, const std::string& unit, float scale, float exposure);

/// Of the colours of the outcomes of shifts.
Legend outcome_legend();

/// Where a legend lies; empty: it was not drawn, or has no bar.
struct LegendPlace {
    ScreenRect whole, bar;
};

/// Draws a legend in a lower corner of a picture if there is room: the left one, or the right. Noted as `id`. To
/// be called after the item that the picture is.
LegendPlace draw_legend(const ScreenRect& picture, const std::string& id, const Legend& legend, bool at_right,
                        Controls& controls);

} // namespace tessera
