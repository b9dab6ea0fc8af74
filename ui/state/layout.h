#pragma once

#include "ui/gl/theme.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Size and position of the window on the desktop, screen units.
struct WindowPlace {
    glm::ivec2 size{0};                 ///< of the contents when not maximised; 0: unknown
    std::optional<glm::ivec2> position; ///< of their upper left corner when not maximised; empty: unknown
    bool maximised = false;

    bool operator==(const WindowPlace&) const = default;
};

/// Sections of the settings panel that can be collapsed.
enum class PanelSection { method, display, compare, reference, size, limits, expert };

/// The part of the layout that the viewer stores between runs.
struct StoredLayout {
    WindowPlace window;
    Theme theme = Theme::dark;
    float text_factor = 1;  ///< scale of text and controls relative to the display's scale
    float panel_width = 20; ///< of the side panels, in font sizes
    bool show_panel = true;
    unsigned open_sections = 0b0011111; ///< a bit per PanelSection; limits and expert are collapsed by default
    bool show_statistics = false;
    bool show_charts = false;

    bool is_open(PanelSection section) const { return open_sections >> static_cast<int>(section) & 1; }
    void fold(PanelSection section) { open_sections ^= 1u << static_cast<int>(section); }

    bool operator==(const StoredLayout&) const = default;
};

/// Quantity of a chart, against time or samples.
enum class ChartKind {
    error,      ///< relMSE to the reference
    efficiency, ///< 1 / (relMSE x seconds)
    shifts,     ///< fractions of shift outcomes
};

/// Purpose of the file dialog; `jobs` chooses a folder.
enum class FilePurpose { scene, reference, settings, jobs, save };

/// Things that can be saved, each to its own type of file (words::saved).
enum class SaveKind { picture, exr, window, charts, settings, camera };

/// Fields of the dialog that inspects a sample.
struct SampleForm {
    bool show = false;
    glm::ivec2 pixel{0};
    int pass = 0;
    std::uint64_t seed = 0;
};

/// A message over the pictures that disappears by itself.
struct Toast {
    static constexpr double seconds = 5; ///< display time
    std::string text;                    ///< empty: there is none
    double since = 0;                    ///< ImGui::GetTime() when it was first drawn; 0: not drawn yet
};

/// Position of the mouse over a picture.
struct Cursor {
    int pane = 0;
    glm::vec2 place{0}; ///< fractions of the image, from its top left; may lie outside
    float share = 0;    ///< fraction of the pane's width, from the left
};

/// Layout of the window, and which parts are visible.
struct Layout : StoredLayout {
    static constexpr float least_ui_scale = 1, most_ui_scale = 3;
    static constexpr float least_panel_width = 14, most_panel_width = 48;

    glm::ivec2 window_size{0}; ///< as last drawn, screen units
    float display_scale = 1;   ///< the display's scale of text and controls

    bool alone = false;           ///< only the active pane is visible
    float wipe = 0.5f;            ///< position of the wipe's line, a fraction of a pane's width
    bool flicker = false;         ///< while a key is held, the active pane shows the picture it is compared with
    std::optional<Cursor> cursor; ///< empty: the mouse is not over a picture

    bool large_charts = false; ///< drawn over the pictures instead of in the charts panel
    ChartKind chart_kind = ChartKind::error;
    bool charts_by_spp = false; ///< against samples per pixel instead of seconds
    bool show_help = false;
    bool show_palette = false;  ///< the list of all commands
    int palette_steps = 0;      ///< steps down the list by arrow keys since the last frame
    bool palette_takes = false; ///< Return was pressed
    bool show_messages = false;
    bool show_gallery = false;
    bool show_jobs = false; ///< of the followed folder
    Toast toast;
    std::optional<glm::vec3> menu_point; ///< surface point under an open pane menu; empty: none
    SampleForm sample_form;
    std::optional<FilePurpose> choosing;    ///< purpose of the open file dialog; empty: it is closed
    SaveKind save_kind = SaveKind::picture; ///< selected in the save dialog
    std::string save_folder{};              ///< of the last save; empty: the current folder

    bool shows_charts() const { return show_charts || large_charts; }

    /// Returns the scale of text and controls.
    float ui_scale() const { return std::clamp(display_scale * text_factor, least_ui_scale, most_ui_scale); }
    /// Sets the text factor that gives this scale on the present display.
    void set_ui_scale(float scale) {
        text_factor = std::clamp(scale, least_ui_scale, most_ui_scale) / display_scale;
    }

    /// Restores the stored part; the rest stays.
    void restore(const StoredLayout& remembered) { static_cast<StoredLayout&>(*this) = remembered; }
};

} // namespace tessera
