#include "ui/theme.h"

#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <string>

namespace tessera {

namespace {

constexpr float font_pixels = 15.0f;

Icons found_icons;
ImFont* found_bold = nullptr;
ImFont* found_mono = nullptr;

// Dear ImGui aborts on a font that is not there.
std::string first_existing(std::initializer_list<const char*> candidates) {
    std::error_code ignored;
    for (const char* path : candidates) {
        if (std::filesystem::is_regular_file(path, ignored))
            return path;
    }
    return {};
}

// Basic Latin and Latin-1, some Greek, dashes, dots, minus, arrows.
constexpr ImWchar text_glyphs[] = {0x0020, 0x00ff, 0x0391, 0x03c9, 0x2010, 0x2027, 0x2190,
                                   0x2193, 0x2212, 0x2212, 0x2264, 0x2265, 0};
// Only those in use: the whole font would take a fifth of a second.
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
    config.GlyphMinAdvanceX = pixels; // icons stand in columns
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

ImVec4 grey(float value, float alpha = 1.0f) {
    return {value * 0.95f, value * 0.98f, value * 1.08f, alpha};
}

ImVec4 accent(float strength, float alpha) {
    return {0.25f * strength, 0.77f * strength, 0.70f * strength, alpha};
}

void set_colours(ImGuiStyle& style) {
    ImGui::StyleColorsDark(&style);
    ImVec4* c = style.Colors;
    c[ImGuiCol_Text] = ImGui::ColorConvertU32ToFloat4(colours::text);
    c[ImGuiCol_TextDisabled] = ImGui::ColorConvertU32ToFloat4(colours::dim_text);
    c[ImGuiCol_WindowBg] = ImGui::ColorConvertU32ToFloat4(colours::panel);
    c[ImGuiCol_ChildBg] = {0, 0, 0, 0};
    c[ImGuiCol_PopupBg] = grey(0.135f, 0.98f);
    c[ImGuiCol_MenuBarBg] = grey(0.085f);
    c[ImGuiCol_Border] = grey(0.24f);
    c[ImGuiCol_FrameBg] = grey(0.175f);
    c[ImGuiCol_FrameBgHovered] = grey(0.225f);
    c[ImGuiCol_FrameBgActive] = grey(0.26f);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = grey(0.085f);
    c[ImGuiCol_Button] = grey(0.205f);
    c[ImGuiCol_ButtonHovered] = grey(0.275f);
    c[ImGuiCol_ButtonActive] = accent(0.55f, 1.0f);
    c[ImGuiCol_Header] = accent(0.42f, 0.75f);
    c[ImGuiCol_HeaderHovered] = accent(0.55f, 0.75f);
    c[ImGuiCol_HeaderActive] = accent(0.60f, 0.90f);
    c[ImGuiCol_CheckMark] = accent(1.0f, 1.0f);
    c[ImGuiCol_SliderGrab] = accent(0.62f, 1.0f); // text crosses it
    c[ImGuiCol_SliderGrabActive] = accent(0.80f, 1.0f);
    c[ImGuiCol_Separator] = grey(0.22f);
    c[ImGuiCol_TextSelectedBg] = accent(0.7f, 0.5f);
    c[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
    c[ImGuiCol_ScrollbarGrab] = grey(0.28f);
    c[ImGuiCol_TableHeaderBg] = grey(0.16f);
    c[ImGuiCol_TableBorderLight] = grey(0.20f);
    c[ImGuiCol_TableBorderStrong] = grey(0.24f);
    c[ImGuiCol_ModalWindowDimBg] = {0, 0, 0, 0.55f};
}

} // namespace

void apply_theme(float scale) {
    ImGuiStyle style;
    set_colours(style);
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

} // namespace tessera
