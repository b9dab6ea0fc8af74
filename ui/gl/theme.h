#pragma once

#include "render/settings/settings.h"

#include <imgui.h>

namespace tessera {

/// Colours, spaces and fonts of the viewer, for Dear ImGui's current context.

enum class Theme { dark, light };

/// `scale` is the display's: 1 for about 96 pixels an inch. Sets the style and fills the font atlas; to be called
/// between frames. The OpenGL backend's copy of the fonts must be made anew by the caller.
void apply_theme(float scale, Theme theme);

/// The scale that was applied last.
float ui_scale();

/// Drawn in the font: pictures where Font Awesome is there, else empty strings.
struct Icons {
    const char* play = "";
    const char* pause = "";
    const char* restart = "";
    const char* camera = "";
    const char* help = "";
    const char* warning = "";
    const char* note = "";
};
const Icons& icons();

/// The font of headings; the regular one where there is no bold.
ImFont* bold_font();
/// A font of one width, for text with columns: error messages point into lines of files.
ImFont* mono_font();

/// The colours of the theme that was applied last.
namespace colours {
extern ImU32 text, dim_text, accent, error, warning, line, panel;

// Boxes over pictures have these in every theme.
inline constexpr ImU32 overlay = IM_COL32(20, 22, 26, 215);
inline constexpr ImU32 overlay_text = IM_COL32(226, 228, 233, 255);
inline constexpr ImU32 overlay_dim_text = IM_COL32(146, 151, 163, 255);
inline constexpr ImU32 overlay_line = IM_COL32(58, 61, 70, 255);
inline constexpr ImU32 overlay_accent = IM_COL32(64, 196, 178, 255);
} // namespace colours

/// The colour that stands for a method wherever methods are compared: for dark grounds, and as ink on light ones.
ImU32 method_colour(Method method);
ImU32 method_ink(Method method);

/// The colour with another opacity, in [0, 1].
ImU32 with_alpha(ImU32 colour, float alpha);

} // namespace tessera
