#include "ui/gl/theme.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <system_error>

#include <glm/common.hpp>

namespace tessera {

namespace colours {
ImU32 text, dim_text, accent, error, warning, line, panel;
} // namespace colours

namespace {

constexpr float font_pixels = 15.0f;

float applied_scale = 1;
Icons found_icons;
ImFont* found_bold = nullptr;
ImFont* found_mono = nullptr;

/// Returns the first file that exists, or an empty string: Dear ImGui aborts on a missing font.
std::string first_existing(std::initializer_list<const char*> candidates) {
    std::error_code ignored;
    for (const char* path : candidates) {
        if (std::filesystem::is_regular_file(path, ignored))
            return path;
    }
    return {};
}

// Basic Latin and Latin-1, Greek, dashes, dots, arrows, minus, and comparison signs.
constexpr ImWchar text_glyphs[] = {0x0020, 0x00ff, 0x0391, 0x03c9, 0x2010, 0x2027, 0x2190,
                                   0x2193, 0x2212, 0x2212, 0x2264, 0x2265, 0};
// Only the icons in use: loading the whole font would delay the start.
constexpr ImWchar icon_glyphs[] = {0xf01e, 0xf01e, 0xf029, 0xf029, 0xf030, 0xf030, 0xf04b,
                                   0xf04c, 0xf05a, 0xf05a, 0xf071, 0xf071, 0};

ImFont* add_text_font(const std::string& file, float pixels) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    if (file.empty()) {
        ImFontConfig config;
        config.SizePixels = std::floor(pixels * 13.0f / font_pixels);
        return atlas.AddFontDefault(&config);
    }
    ImFontConfig config;
    config.OversampleH = 2;
    config.OversampleV = 1;
    return atlas.AddFontFromFileTTF(file.c_str(), pixels, &config, text_glyphs);
}

void merge_icons(float pixels) {
    found_icons = {};
    const std::string file = first_existing({"/usr/share/fonts/truetype/font-awesome/fontawesome-webfont.ttf",
                                             "/usr/share/fonts/opentype/font-awesome/FontAwesome.otf",
                                             "/usr/share/fonts-font-awesome/fonts/fontawesome-webfont.ttf"});
    if (file.empty())
        return;
    ImFontConfig config;
    config.MergeMode = true;
    config.GlyphMinAdvanceX = pixels; // so that icons align in columns
    config.OversampleH = 2;
    config.OversampleV = 1;
    ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), std::floor(pixels * 0.93f), &config, icon_glyphs);
    found_icons = {"\xef\x81\x8b", "\xef\x81\x8c", "\xef\x80\x9e", "\xef\x80\xb0",
                   "\xef\x80\xa9", "\xef\x81\xb1", "\xef\x81\x9a"};
}

void load_fonts(float scale) {
    ImGui::GetIO().Fonts->Clear();
    const float pixels = std::round(font_pixels * scale);
    const std::string regular = first_existing(
        {"/usr/share/fonts/opentype/inter/Inter-Regular.otf", "/usr/share/fonts/opentype/inter/InterVariable.otf",
         "/usr/share/fonts/truetype/inter/Inter-Regular.ttf",
         "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
         "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"});
    add_text_font(regular, pixels);
    merge_icons(pixels);
    const std::string bold = first_existing({"/usr/share/fonts/opentype/inter/Inter-SemiBold.otf",
                                             "/usr/share/fonts/truetype/inter/Inter-SemiBold.ttf"});
    found_bold = bold.empty() ? ImGui::GetIO().Fonts->Fonts[0] : add_text_font(bold, pixels);
    const std::string mono = first_existing({"/usr/share/fonts/truetype/jetbrains-mono/JetBrainsMono-Regular.ttf",
                                             "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf"});
    found_mono = add_text_font(mono, pixels);
}

/// Chooses between the values of a colour for the dark theme and for the light one.
struct Palette {
    Theme theme;

    bool is_dark() const { return theme == Theme::dark; }
    ImVec4 grey(float dark, float light, float alpha = 1.0f) const {
        const float value = is_dark() ? dark : light;
        return is_dark() ? ImVec4(value * 0.95f, value * 0.98f, value * 1.08f, alpha)
                         : ImVec4(value * 0.99f, value * 0.995f, value, alpha);
    }
    /// Returns the accent colour of a strength: brighter in the dark theme, darker in the light one.
    ImVec4 accent(float dark, float light, float alpha) const {
        return is_dark() ? ImVec4(0.25f * dark, 0.77f * dark, 0.70f * dark, alpha)
                         : ImVec4(glm::mix(1.0f, 0.0f, light), glm::mix(1.0f, 0.56f, light),
                                  glm::mix(1.0f, 0.50f, light), alpha);
    }
};

void set_named_colours(Theme theme) {
    using namespace colours;
    const bool dark = theme == Theme::dark;
    text = dark ? IM_COL32(226, 228, 233, 255) : IM_COL32(28, 30, 36, 255);
    dim_text = dark ? IM_COL32(146, 151, 163, 255) : IM_COL32(92, 97, 108, 255);
    colours::accent = dark ? IM_COL32(64, 196, 178, 255) : IM_COL32(0, 133, 118, 255);
    error = dark ? IM_COL32(255, 122, 105, 255) : IM_COL32(190, 32, 22, 255);
    warning = dark ? IM_COL32(255, 196, 92, 255) : IM_COL32(150, 92, 0, 255);
    line = dark ? IM_COL32(58, 61, 70, 255) : IM_COL32(200, 203, 210, 255);
    panel = dark ? IM_COL32(27, 29, 34, 255) : IM_COL32(243, 244, 246, 255);
}

void set_colours(ImGuiStyle& style, const Palette& p) {
    if (p.is_dark())
        ImGui::StyleColorsDark(&style);
    else
        ImGui::StyleColorsLight(&style);
    ImVec4* c = style.Colors;
    c[ImGuiCol_Text] = ImGui::ColorConvertU32ToFloat4(colours::text);
    c[ImGuiCol_TextDisabled] = ImGui::ColorConvertU32ToFloat4(colours::dim_text);
    c[ImGuiCol_WindowBg] = ImGui::ColorConvertU32ToFloat4(colours::panel);
    c[ImGuiCol_ChildBg] = {0, 0, 0, 0};
    c[ImGuiCol_PopupBg] = p.grey(0.135f, 0.99f, 0.98f);
    c[ImGuiCol_MenuBarBg] = p.grey(0.085f, 0.90f);
    c[ImGuiCol_Border] = p.grey(0.24f, 0.76f);
    c[ImGuiCol_FrameBg] = p.grey(0.175f, 0.87f);
    c[ImGuiCol_FrameBgHovered] = p.grey(0.225f, 0.83f);
    c[ImGuiCol_FrameBgActive] = p.grey(0.26f, 0.80f);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = p.grey(0.085f, 0.90f);
    c[ImGuiCol_Button] = p.grey(0.205f, 0.85f);
    c[ImGuiCol_ButtonHovered] = p.grey(0.275f, 0.79f);
    c[ImGuiCol_ButtonActive] = p.accent(0.55f, 0.55f, 1.0f);
    c[ImGuiCol_Header] = p.accent(0.42f, 0.35f, 0.75f);
    c[ImGuiCol_HeaderHovered] = p.accent(0.55f, 0.45f, 0.75f);
    c[ImGuiCol_HeaderActive] = p.accent(0.60f, 0.55f, 0.90f);
    c[ImGuiCol_CheckMark] = p.accent(1.0f, 1.0f, 1.0f);
    c[ImGuiCol_SliderGrab] = p.accent(0.62f, 0.50f, 1.0f); // muted, since text crosses it
    c[ImGuiCol_SliderGrabActive] = p.accent(0.80f, 0.65f, 1.0f);
    c[ImGuiCol_Separator] = p.grey(0.22f, 0.78f);
    c[ImGuiCol_TextSelectedBg] = p.accent(0.7f, 0.6f, 0.5f);
    c[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
    c[ImGuiCol_ScrollbarGrab] = p.grey(0.28f, 0.72f);
    c[ImGuiCol_TableHeaderBg] = p.grey(0.16f, 0.90f);
    c[ImGuiCol_TableBorderLight] = p.grey(0.20f, 0.84f);
    c[ImGuiCol_TableBorderStrong] = p.grey(0.24f, 0.76f);
    c[ImGuiCol_ModalWindowDimBg] = {0, 0, 0, 0.55f};
}

} // namespace

void apply_theme(float scale, Theme theme) {
    ImGuiStyle style;
    applied_scale = scale;
    set_named_colours(theme);
    set_colours(style, {theme});
    style.WindowPadding = {10, 8};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 6};
    style.ItemInnerSpacing = {6, 4};
    style.WindowRounding = 0;
    style.PopupRounding = 5;
    style.FrameRounding = 4;
    style.GrabRounding = 4;
    style.ScrollbarRounding = 6;
    style.ScrollbarSize = 11;
    style.GrabMinSize = 11;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.WindowMinSize = {1, 1};
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
    load_fonts(scale);
}

float ui_scale() {
    return applied_scale;
}
const Icons& icons() {
    return found_icons;
}
ImFont* bold_font() {
    return found_bold;
}
ImFont* mono_font() {
    return found_mono;
}

ImU32 method_colour(Method method) {
    switch (method) {
    case Method::pt:
        return IM_COL32(126, 156, 216, 255);
    case Method::pr:
        return IM_COL32(222, 164, 90, 255);
    case Method::gpt:
        return IM_COL32(196, 130, 214, 255);
    case Method::gpr:
        return IM_COL32(76, 200, 176, 255);
    }
    return colours::text;
}

ImU32 method_ink(Method method) {
    switch (method) {
    case Method::pt:
        return IM_COL32(52, 96, 190, 255);
    case Method::pr:
        return IM_COL32(194, 116, 8, 255);
    case Method::gpt:
        return IM_COL32(158, 62, 188, 255);
    case Method::gpr:
        return IM_COL32(0, 140, 116, 255);
    }
    return colours::text;
}

ImU32 with_alpha(ImU32 colour, float alpha) {
    const auto bits = static_cast<ImU32>(std::clamp(alpha, 0.0f, 1.0f) * 255);
    return (colour & ~IM_COL32_A_MASK) | (bits << IM_COL32_A_SHIFT);
}

} // namespace tessera
