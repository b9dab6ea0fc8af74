#pragma once

#include "ui/gl/theme.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>

namespace tessera {

/// Where a window is on the desktop, in screen units.
struct WindowPlace {
    glm::ivec2 size{0};                 ///< of its contents while it is not maximised; 0: not known
    std::optional<glm::ivec2> position; ///< likewise, of their upper left corner; empty: not known
    bool maximised = false;

    bool operator==(const WindowPlace&) const = default;
};

/// What of the layout the viewer remembers from one run to the next.
struct LastingLayout {
    WindowPlace window; ///< as it is now
    Theme theme = Theme::dark;
    float text_factor = 1;  ///< of text and controls, against the display's: another one has as large a text
    float panel_width = 20; ///< of the panels at the side, in heights of a line
    bool show_panel = true;
    bool show_statistics = false;
    bool show_charts = false;

    bool operator==(const LastingLayout&) const = default;
};

/// What a chart shows of the panes, against time or samples.
enum class ChartKind {
    error,      ///< relMSE to the reference
    efficiency, ///< 1 / (relMSE x seconds)
    shifts,     ///< how many of the shifts ended how
};

/// What a file is chosen for.
enum class FilePurpose { scene, reference, settings };

/// What the dialog for a sample asks for.
struct SampleForm {
    bool show = false;
    glm::ivec2 pixel{0};
    int pass = 0;
    std::uint64_t seed = 0;
};

/// What the mouse points at.
struct Cursor {
    int pane = 0;
    glm::vec2 place{0}; ///< fractions of the image, from its top left; may lie outside
    float share = 0;    ///< of the pane's width, from the left
};

/// How the window is divided, and what is on show in it.
struct Layout : LastingLayout {
    static constexpr float least_ui_scale = 1, most_ui_scale = 3;
    static constexpr float least_panel_width = 14, most_panel_width = 48;

    glm::ivec2 window_size{0}; ///< as last drawn, screen units
    float display_scale = 1;   ///< of text and controls, as the display says

    bool alone = false;           ///< only the active pane is on show
    float wipe = 0.5f;            ///< where wiped pictures are divided, a share of a pane's width
    bool flicker = false;         ///< while a key is held: the active pane shows the one that it is compared with
    std::optional<Cursor> cursor; ///< empty: it is over no picture

    bool large_charts = false; ///< over the pictures instead of in their panel
    ChartKind chart_kind = ChartKind::error;
    bool charts_by_spp = false; ///< against samples; otherwise against seconds
    bool show_help = false;
    bool show_messages = false;
    SampleForm sample_form;
    std::optional<FilePurpose> choosing; ///< a file, in the dialog for it; empty: it is closed

    bool shows_charts() const { return show_charts || large_charts; }

    /// The scale of text and controls.
    float ui_scale() const { return std::clamp(display_scale * text_factor, least_ui_scale, most_ui_scale); }
    /// Sets the factor that leads to that scale on this display.
    void set_ui_scale(float scale) {
        text_factor = std::clamp(scale, least_ui_scale, most_ui_scale) / display_scale;
    }

    /// Takes what was remembered; the rest stays as it is.
    void restore(const LastingLayout& remembered) { static_cast<LastingLayout&>(*this) = remembered; }
};

} // namespace tessera
