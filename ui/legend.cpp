#include "ui/legend.h"

#include "ui/false_colours.h"
#include "ui/theme.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

namespace tessera {

namespace {

ImU32 colour(std::size_t i) {
    const glm::vec3 c = false_colours[i];
    return ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1});
}

void draw_colours(ImDrawList& list, glm::vec2 min, glm::vec2 max) {
    const float step = (max.x - min.x) / static_cast<float>(false_colours.size() - 1);
    for (std::size_t i = 0; i + 1 < false_colours.size(); ++i) {
        const float left = min.x + step * static_cast<float>(i);
        list.AddRectFilledMultiColor({left, min.y}, {left + step, max.y}, colour(i), colour(i + 1), colour(i + 1),
                                     colour(i));
    }
}

} // namespace

ScreenRect draw_legend(const ScreenRect& picture, const std::string& id, Buffer buffer, const ValueRange& range,
                       bool at_right, Controls& controls) {
    const std::string text = legend_text(buffer, range);
    const float font = ImGui::GetFontSize(), pad = std::floor(font * 0.5f), bar = std::floor(font * 0.5f);
    const ImVec2 text_size = ImGui::CalcTextSize(text.c_str());
    const glm::vec2 size(std::max(text_size.x, font * 10) + 2 * pad, text_size.y + bar + 2.5f * pad);
    if (size.x + 2 * pad > picture.size().x || size.y + 2 * pad > picture.size().y)
        return {};
    const float left = at_right ? picture.max.x - pad - size.x : picture.min.x + pad;
    const glm::vec2 min(left, picture.max.y - pad - size.y), max = min + size;

    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({min.x, min.y}, {max.x, max.y}, colours::overlay, pad * 0.5f);
    list.AddText({min.x + pad, min.y + pad}, colours::overlay_text, text.c_str());
    const ScreenRect colours_at{{min.x + pad, max.y - pad - bar}, {max.x - pad, max.y - pad}};
    draw_colours(list, colours_at.min, colours_at.max);

    const ImVec2 cursor = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({min.x, min.y});
    ImGui::Dummy({size.x, size.y});
    const std::string help =
        std::string(info(buffer).help) +
        "\n\nDrag the colours' left or right half to move that end of their range; double click: "
        "back to the range that fits the image.";
    controls.note(id.c_str(), help.c_str());
    ImGui::SetCursorScreenPos(cursor);
    return colours_at;
}

} // namespace tessera
