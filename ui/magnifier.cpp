#include "ui/magnifier.h"

#include "ui/imgui_version.h"
#include "ui/theme.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace tessera {

namespace {
constexpr float edge_ems = 11;
constexpr float pixels_across = 11; // of the image, unless they are larger anyway
constexpr float least_factor = 2;
} // namespace

CanvasView magnified(const CanvasView& view, glm::ivec2 image_size, glm::vec2 place, int pixels) {
    const float present = view.image_extent.x / static_cast<float>(image_size.x); // pixels a pixel of the image
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
