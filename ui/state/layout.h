#pragma once

#include "ui/gl/theme.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Where a window is on the desktop, in screen units.
struct WindowPlace {
    glm::ivec2 size{0};                 ///< of its contents while it is not maximised; 0: not known
    std::optional<glm::ivec2> position; ///< likewise, of their upper left corner; empty: not known
    bool maximised = false;

    bool operator==(const WindowPlace&) const = default;
};

/// Sections of the settings, which can be folded away.
enum class PanelSection { method, display, compare, reference, size, limits, expert };

/// What of the layout the viewer remembers from one run to the next.
struct LastingLayout {
    WindowPlace window; ///< as it is now
    Theme theme = Theme::dark;
    float text_factor = 1;  ///< of text and controls, against the display's: another one has as large a text
    float panel_width = 20; ///< of the panels at the side, in heights of a line
    bool show_panel = true;
    unsigned open_sections =
        0b0011111; ///< a bit for each PanelSection: limits and expert are folded away at first
    bool show_statistics = false;
    bool show_charts = false;

    bool is_open(PanelSection section) const { return open_sections >> static_cast<int>(section) & 1; }
    void fold(PanelSection section) { open_sections ^= 1u << static_cast<int>(section); }

    bool operator==(const LastingLayout&) const = default;
};

/// What a chart shows of the panes, against time or samples.
enum class ChartKind {
    error,      ///< relMSE to the reference
    efficiency, ///< 1 / (relMSE x seconds)
    shifts,     ///< how many of the shifts ended how
};

/// What a file is chosen for; of jobs, a folder.
enum class FilePurpose { scene, reference, settings, jobs, save };

/// What can be saved, each to a file of its own kind (words::saved).
enum class SaveKind { picture, exr, window, charts, settings, camera };

/// What the dialog for a sample asks for.
struct SampleForm {
    bool show = false;
    glm::ivec2 pixel{0};
    int pass = 0;
    std::uint64_t seed = 0;
};

/// Words over the pictures that go by themselves.
struct Toast {
    static constexpr double seconds = 5; ///< for which it stays
    std::string text;                    ///< empty: there is none
    double since = 0;                    ///< ImGui::GetTime() when it was first drawn; 0: it was not yet
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
    bool show_palette = false;  ///< the list of all commands
    int palette_steps = 0;      ///< down the list, as typed since it was drawn
    bool palette_takes = false; ///< Return was typed
    bool show_messages = false;
    bool show_gallery = false; ///< of scenes, over the pictures
    bool show_jobs = false;    ///< of the folder that is followed, over the pictures
    Toast toast;
    std::optional<glm::vec3> menu_point; ///< what a pane's menu was opened over; empty: nothing
    SampleForm sample_form;
    std::optional<FilePurpose> choosing;    ///< a file, in the dialog for it; empty: it is closed
    SaveKind save_kind = SaveKind::picture; ///< what the dialog is to save
    std::string save_folder{};              ///< where the dialog saved last; empty: the current folder

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
