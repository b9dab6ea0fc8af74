#include "ui/legend.h"

#include "ui/false_colours.h"
#include "ui/theme.h"

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

const char* help(Buffer buffer) {
    return buffer == Buffer::failed ? "The share of the shifts to a pixel that brought it no light."
                                    : "The base paths of other pixels that brought light to a pixel, a pass.";
}

} // namespace

void draw_legend(const ScreenRect& picture, const std::string& id, Buffer buffer, float top, Controls& controls) {
    const std::string text = legend_text(buffer, top);
    const float font = ImGui::GetFontSize(), pad = std::floor(font * 0.5f), bar = std::floor(font * 0.5f);
    const ImVec2 text_size = ImGui::CalcTextSize(text.c_str());
    const glm::vec2 size(text_size.x + 2 * pad, text_size.y + bar + 2.5f * pad);
    if (size.x + 2 * pad > picture.size().x || size.y + 2 * pad > picture.size().y)
        return;
    const glm::vec2 min(picture.min.x + pad, picture.max.y - pad - size.y), max = min + size;

    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({min.x, min.y}, {max.x, max.y}, IM_COL32(20, 22, 26, 215), pad * 0.5f);
    list.AddText({min.x + pad, min.y + pad}, colours::text, text.c_str());
    draw_colours(list, {min.x + pad, max.y - pad - bar}, {max.x - pad, max.y - pad});

    const ImVec2 cursor = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({min.x, min.y});
    ImGui::Dummy({size.x, size.y});
    controls.note(id.c_str(), help(buffer));
    ImGui::SetCursorScreenPos(cursor);
}

} // namespace tessera
