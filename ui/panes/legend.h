#pragma once

#include "ui/gl/controls.h"
#include "ui/gl/image_view.h"
#include "ui/panes/pane_parts.h"
#include "ui/state/buffer.h"

#include <array>
#include <optional>
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

/// The legend of a buffer's false colours, whose bar is for dragging.
Legend false_colour_legend(Buffer buffer, const ValueRange& range);
/// The legend of +/- colours at an exposure in stops. `about` says what the numbers are, which are shown times
/// `scale`.
Legend signed_legend(const std::string& about, const std::string& unit, float scale, float exposure);

/// The legend of the outcomes of shifts.
Legend outcome_legend();

/// Where a legend lies; empty: it was not drawn, or has no bar.
struct LegendPlace {
    ScreenRect whole, bar;
};

/// Draws a legend in a lower corner of a picture if there is room: the left one, or the right. Noted as `id`. To
/// be called after the item that the picture is.
LegendPlace draw_legend(const ScreenRect& picture, const std::string& id, const Legend& legend, bool at_right,
                        Controls& controls);

/// An end of a false colours' range that the mouse holds.
struct HeldRange {
    Buffer buffer = Buffer::reconstruction;
    bool high = false;
    float from = 0;   ///< where the mouse took hold, screen units
    float length = 1; ///< of the legend's colours
    ValueRange range; ///< as it was then

    /// The range when the mouse is at `x`.
    ValueRange at(float x) const;
};

/// The legends over a pane's picture: of what is shown on each side of its line that is on the screen, in that
/// side's corner. Two sides with the same colours have one. Pictures of an earlier view are marked here, too.
class PaneLegends {
public:
    /// `id` of the pane. To be called after the item that the picture is.
    void draw(const PictureFrame& frame, const std::string& id, int pane, PaneTools& tools);

    /// What a point of the screen takes hold of; empty: no colours lie there, or none that can be moved.
    std::optional<HeldRange> held_at(glm::vec2 point, const PaneTools& tools) const;

private:
    struct Drawn {
        LegendPlace place; // without a bar: nothing to take hold of
        Buffer buffer = Buffer::reconstruction;
    };
    static Drawn draw_one(const ScreenRect& rect, const std::string& id, const Showing& showing, bool at_right,
                          PaneTools& tools);
    std::array<Drawn, 2> drawn_; // left and right, as last drawn
};

} // namespace tessera
