#include "ui/legend.h"

#include "render/load/png.h"
#include "ui/false_colours.h"
#include "ui/theme.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/common.hpp>
#include <imgui.h>

namespace tessera {

namespace {

// As in canvas.frag.glsl.
constexpr glm::vec3 zero_colour(0.10f, 0.10f, 0.11f), plus_colour(1.00f, 0.66f, 0.20f),
    minus_colour(0.26f, 0.62f, 1.00f);
constexpr int signed_steps = 16; // to each side of zero: sRGB's curve is no line

ImU32 packed(const glm::vec3& c) {
    return ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1});
}

void draw_colours(ImDrawList& list, glm::vec2 min, glm::vec2 max, const std::vector<glm::vec3>& colours) {
    const float step = (max.x - min.x) / static_cast<float>(colours.size() - 1);
    for (std::size_t i = 0; i + 1 < colours.size(); ++i) {
        const float left = min.x + step * static_cast<float>(i);
        const ImU32 from = packed(colours[i]), to = packed(colours[i + 1]);
        list.AddRectFilledMultiColor({left, min.y}, {left + step, max.y}, from, to, to, from);
    }
}

} // namespace

Legend false_colour_legend(Buffer buffer, const ValueRange& range) {
    return {
        legend_text(buffer, range),
        std::string(info(buffer).help) +
            "\n\nAll panes that show it have this range. Drag the colours' left or right half to move that end "
            "of it; double click: back to the range that fits the first pictures.",
        {std::begin(false_colours), std::end(false_colours)}};
}

Legend signed_legend(const std::string& about, const std::string& unit, float scale, float exposure) {
    const double end = static_cast<double>(std::exp2(-exposure) * scale);
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, ": %+.3g .. %+.3g", -end, end);
    Legend legend{about + numbers + (unit.empty() ? "" : " ") + unit,
                  "Luminance: blue below zero, orange above. The exposure (+ and -) moves the ends.",
                  {}};
    for (int i = -signed_steps; i <= signed_steps; ++i) {
        const float share = static_cast<float>(i) / signed_steps;
        legend.colours.push_back(
            glm::mix(zero_colour, share < 0 ? minus_colour : plus_colour, srgb_encoded(std::abs(share))));
    }
    return legend;
}

ScreenRect draw_legend(const ScreenRect& picture, const std::string& id, const Legend& legend, bool at_right,
                       Controls& controls) {
    const float font = ImGui::GetFontSize(), pad = std::floor(font * 0.5f), bar = std::floor(font * 0.5f);
    const ImVec2 text_size = ImGui::CalcTextSize(legend.text.c_str());
    const bool has_bar = !legend.colours.empty();
    const glm::vec2 size(std::max(text_size.x, has_bar ? font * 10 : 0) + 2 * pad,
                         text_size.y + 2 * pad + (has_bar ? bar + 0.5f * pad : 0));
    if (size.x + 2 * pad > picture.size().x || size.y + 2 * pad > picture.size().y)
        return {};
    const float left = at_right ? picture.max.x - pad - size.x : picture.min.x + pad;
    const glm::vec2 min(left, picture.max.y - pad - size.y), max = min + size;

    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({min.x, min.y}, {max.x, max.y}, colours::overlay, pad * 0.5f);
    list.AddText({min.x + pad, min.y + pad}, colours::overlay_text, legend.text.c_str());
    const ScreenRect colours_at{{min.x + pad, max.y - pad - bar}, {max.x - pad, max.y - pad}};
    if (has_bar)
        draw_colours(list, colours_at.min, colours_at.max, legend.colours);

    const ImVec2 cursor = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({min.x, min.y});
    ImGui::Dummy({size.x, size.y});
    controls.note(id.c_str(), legend.help.c_str());
    ImGui::SetCursorScreenPos(cursor);
    return has_bar ? colours_at : ScreenRect{};
}

} // namespace tessera
