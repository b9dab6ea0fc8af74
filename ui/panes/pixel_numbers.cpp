#include "ui/gl/gui.h"
#include "ui/gl/theme.h"
#include "ui/panes/pane_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/common.hpp>
#include <imgui.h>

namespace tessera {

namespace {

constexpr int characters = 7; // "-0.0123": longest value of a pixel

/// Draws text with a shadow, which makes it readable on bright pixels.
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
    const RgbImage& image = images[first.pane].pixels();
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

namespace {
constexpr float edge_ems = 11;      // edge of the magnifier, font sizes
constexpr float pixels_across = 11; // image pixels across the magnifier, or fewer by least_factor
constexpr float least_factor = 2;   // minimum enlargement of the displayed picture
} // namespace

CanvasView magnified(const CanvasView& view, glm::ivec2 image_size, glm::vec2 place, int pixels) {
    const float present = view.image_extent.x / static_cast<float>(image_size.x); // screen pixels per image pixel
    const float wanted = std::max(static_cast<float>(pixels) / pixels_across, present * least_factor);
    CanvasView result = view;
    result.pane_size = glm::ivec2(pixels);
    result.image_extent = view.image_extent * (wanted / present);
    result.image_origin = glm::round(glm::vec2(static_cast<float>(pixels) * 0.5f) - place * result.image_extent);
    return result;
}

int magnifier_pixels(const PictureFrame& frame) {
    return std::max(static_cast<int>(edge_ems * ImGui::GetFontSize() * frame.pixels_a_unit), 1);
}

void draw_magnifier(const PictureFrame& frame, const CanvasView& view, glm::ivec2 image_size, glm::vec2 place,
                    GLuint rendition) {
    const float edge = static_cast<float>(view.pane_size.x) / frame.pixels_a_unit;
    const glm::vec2 min = glm::floor(frame.to_screen(place) - edge * 0.5f), max = min + edge;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({frame.rect.min.x, frame.rect.min.y}, {frame.rect.max.x, frame.rect.max.y}, true);
    list.AddImage(texture_id(rendition), {min.x, min.y}, {max.x, max.y}, {0, 1}, {1, 0});
    const glm::vec2 size(image_size), corner = glm::floor(place * size) / size;
    const glm::vec2 a = min + (view.image_origin + corner * view.image_extent) / frame.pixels_a_unit;
    const glm::vec2 b = a + view.image_extent / size / frame.pixels_a_unit;
    list.AddRect({a.x - 1, a.y - 1}, {b.x + 1, b.y + 1}, IM_COL32(0, 0, 0, 255));
    list.AddRect({a.x, a.y}, {b.x, b.y}, IM_COL32(255, 255, 255, 255));
    list.AddRect({min.x, min.y}, {max.x, max.y}, colours::accent, 0, 0, 2);
    list.PopClipRect();
}

} // namespace tessera
