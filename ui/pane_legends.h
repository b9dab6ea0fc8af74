#pragma once

#include "ui/legend.h"
#include "ui/pane_tools.h"
#include "ui/picture_frame.h"

#include <array>
#include <optional>
#include <string>

namespace tessera {

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
