#include "ui/pixel_numbers.h"

#include "ui/theme.h"

#include <cmath>
#include <cstdio>

#include <glm/common.hpp>
#include <imgui.h>

namespace tessera {

namespace {

constexpr int characters = 7; // "-0.0123": what a pixel must have room for, in three lines

/// Readable on bright pixels, too.
void draw_shadowed(ImDrawList& list, float font, ImVec2 at, const char* text) {
    const float edge = std::max(std::floor(font / 14), 1.0f);
    list.AddText(mono_font(), font, {at.x + edge, at.y + edge}, IM_COL32(0, 0, 0, 230), text);
    list.AddText(mono_font(), font, {at.x + edge, at.y}, IM_COL32(0, 0, 0, 130), text);
    list.AddText(mono_font(), font, at, IM_COL32(255, 255, 255, 255), text);
}

void draw_value(ImDrawList& list, float font, glm::vec2 center, const Rgb& value, int lines) {
    float y = std::floor(center.y - font * 0.5f * static_cast<float>(lines));
    for (int i = 0; i < lines; ++i, y += font) {
        const std::string text = short_number(value[i]);
        const float width = mono_font()->CalcTextSizeA(font, 1e6f, 0, text.c_str()).x;
        draw_shadowed(list, font, {std::floor(center.x - width * 0.5f), y}, text.c_str());
    }
}

} // namespace

std::string short_number(float value) {
    char text[24];
    int length = characters + 1;
    for (int digits = 3; digits > 0 && length > characters; --digits)
        length = std::snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(value));
    return text;
}

bool draw_pixel_numbers(const PictureFrame& frame, int pane, const ViewerState& state, const PaneImages& images) {
    const Showing first = showing_at(state, pane, 0);
    const RgbImage& image = images[static_cast<std::size_t>(first.pane)].pixels();
    if (image.empty())
        return false;
    const glm::vec2 size(image.width(), image.height());
    const glm::vec2 pixel = frame.placement.extent / size / frame.pixels_a_unit; // screen units
    const float font = ImGui::GetFontSize();
    const float width = mono_font()->CalcTextSizeA(font, 1e6f, 0, "0").x * characters;
    if (pixel.x < width || pixel.y < font * 3.3f)
        return false;

    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({frame.rect.min.x, frame.rect.min.y}, {frame.rect.max.x, frame.rect.max.y}, true);
    const glm::ivec2 from = glm::max(glm::ivec2(glm::floor(frame.to_image(frame.rect.min) * size)), glm::ivec2(0));
    const glm::ivec2 to = glm::min(glm::ivec2(glm::ceil(frame.to_image(frame.rect.max) * size)), glm::ivec2(size));
    for (int y = from.y; y < to.y; ++y) {
        for (int x = from.x; x < to.x; ++x) {
            const glm::vec2 place = (glm::vec2(x, y) + 0.5f) / size, center = frame.to_screen(place);
            const Showing showing = showing_at(state, pane, (center.x - frame.rect.min.x) / frame.rect.size().x);
            const bool scalar = has_one_number(colour_map(showing, state));
            if (const std::optional<Rgb> value = value_at(showing, images, place))
                draw_value(list, font, center, *value * info(buffer_of(showing.pane, state)).unit_scale,
                           scalar ? 1 : 3);
        }
    }
    list.PopClipRect();
    return true;
}

} // namespace tessera
