#pragma once

#include "ui/gl/controls.h"
#include "ui/gl/image_view.h"
#include "ui/panes/pane_parts.h"
#include "ui/state/buffer.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <imgui.h>

namespace tessera {

/// A colour and its meaning.
struct LegendEntry {
    std::string name;
    ImU32 colour;
};

/// Explains colours by a caption and either a colour bar or entries.
struct Legend {
    std::string text; ///< caption
    std::string help;
    std::vector<glm::vec3> colours; ///< of the bar, evenly spaced; empty: no bar
    std::vector<LegendEntry> entries;
};
inline constexpr float max_legend_ems = 24; ///< maximum width of the entries, in font sizes

/// Returns the legend of a buffer's false colours, whose bar can be dragged.
Legend false_colour_legend(Buffer buffer, const ValueRange& range);
/// Returns the legend of signed colours.
/// @param about     name of the values
/// @param scale     factor from values to displayed numbers
/// @param exposure  stops
Legend signed_legend(const std::string& about, const std::string& unit, float scale, float exposure);

/// Returns the legend of shift outcomes.
Legend outcome_legend();

/// Position of a drawn legend; empty rectangles: not drawn, or no bar.
struct LegendPlace {
    ScreenRect whole, bar;
};

/// Draws a legend in the lower left or right corner of a picture if there is room, and registers it as `id`. To
/// be called after the picture's item.
LegendPlace draw_legend(const ScreenRect& picture, const std::string& id, const Legend& legend, bool at_right,
                        Controls& controls);

/// An end of a false-colour range that the mouse drags.
struct HeldRange {
    Buffer buffer = Buffer::reconstruction;
    bool high = false; ///< the upper end
    float from = 0;    ///< x of the mouse at the start, screen units
    float length = 1;  ///< of the colour bar, screen units
    ValueRange range;  ///< at the start

    /// Returns the range for a mouse at `x`, screen units.
    ValueRange at(float x) const;
};

/// The legends over a pane's picture, one in the corner of each visible side. Two sides with the same colours
/// share one. Legends also mark pictures of an earlier view.
class PaneLegends {
public:
    /// Draws the legends. To be called after the picture's item.
    /// @param id  of the pane
    void draw(const PictureFrame& frame, const std::string& id, int pane, PaneTools& tools);

    /// Returns the range end that a drag from this screen point moves; empty: there is no false-colour bar.
    std::optional<HeldRange> held_at(glm::vec2 point, const PaneTools& tools) const;

private:
    struct Drawn {
        LegendPlace place; // without a bar if it cannot be dragged
        Buffer buffer = Buffer::reconstruction;
    };
    static Drawn draw_one(const ScreenRect& rect, const std::string& id, const Showing& showing, bool at_right,
                          PaneTools& tools);
    std::array<Drawn, 2> drawn_; // left and right, as last drawn
};

} // namespace tessera
