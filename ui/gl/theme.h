#pragma once

#include "render/settings/settings.h"

#include <imgui.h>

namespace tessera {

/// Colours, spacing and fonts of the viewer, for the current context of Dear ImGui.

enum class Theme { dark, light };

/// Sets the style and fills the font atlas, between frames. The caller must then recreate the OpenGL backend's
/// copy of the fonts.
/// @param scale  of the display: 1 for about 96 pixels an inch
void apply_theme(float scale, Theme theme);

/// Returns the scale that was applied last.
float ui_scale();

/// Icons as text: glyphs of Font Awesome if it is installed, else empty strings.
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

/// Returns the font of headings: bold, or regular if there is no bold font.
ImFont* bold_font();
/// Returns a monospaced font, for text in columns such as error messages that point into lines of files.
ImFont* mono_font();

/// Colours of the theme that was applied last.
namespace colours {
extern ImU32 text, dim_text, accent, error, warning, line, panel;

// Colours of boxes over pictures, the same in every theme.
inline constexpr ImU32 overlay = IM_COL32(20, 22, 26, 215);
inline constexpr ImU32 overlay_text = IM_COL32(226, 228, 233, 255);
inline constexpr ImU32 overlay_dim_text = IM_COL32(146, 151, 163, 255);
inline constexpr ImU32 overlay_line = IM_COL32(58, 61, 70, 255);
inline constexpr ImU32 overlay_accent = IM_COL32(64, 196, 178, 255);
} // namespace colours

/// Return the colour of a method wherever methods are compared: for dark backgrounds, and as ink on light ones.
ImU32 method_colour(Method method);
ImU32 method_ink(Method method);

/// Returns the colour with another opacity, in [0, 1].
ImU32 with_alpha(ImU32 colour, float alpha);

} // namespace tessera
