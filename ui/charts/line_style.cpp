#include "ui/charts/line_style.h"

#include "recon/enumeration.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tessera {

std::span<const float> dashes_of(const LineStyle& look) {
    static constexpr float dots[] = {1, 2}, dashes[] = {5, 3}, short_dashes[] = {2.5f, 2},
                           dash_dots[] = {6, 2, 1, 2}, long_dashes[] = {9, 2},
                           dash_dot_dots[] = {6, 2, 1, 2, 1, 2}, sparse_dots[] = {1, 4}, sparse_dashes[] = {4, 5};
    static constexpr std::span<const float> by_norm[] = {
        dots, dashes, short_dashes, dash_dots, long_dashes, {}, dash_dot_dots, sparse_dots, sparse_dashes};
    const bool has_norm = look.method && (has_gradients(*look.method) || applied(look.norm, false) != Norm::none);
    return has_norm ? entry_of(by_norm, look.norm) : std::span<const float>{};
}

void draw_dashed(std::span<const ImVec2> points, std::span<const float> dashes, ImU32 colour, float width) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (dashes.empty()) {
        list.AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0, width);
        return;
    }
    std::size_t dash = 0;                // index of the dash (even) or gap (odd)
    float remaining = dashes[0] * width; // length left of this dash or gap
    std::vector<ImVec2> stroke;          // points of the dash so far; a dash continues around corners
    const auto end_stroke = [&] {
        list.AddPolyline(stroke.data(), static_cast<int>(stroke.size()), colour, 0, width);
        stroke.clear();
    };
    for (std::size_t i = 1; i < points.size(); ++i) {
        const ImVec2 from = points[i - 1], to = points[i];
        const float length = std::hypot(to.x - from.x, to.y - from.y);
        const auto at = [&](float done) {
            return ImVec2(from.x + (to.x - from.x) * done / length, from.y + (to.y - from.y) * done / length);
        };
        for (float done = 0; done < length;) {
            const float step = std::min(remaining, length - done);
            if (dash % 2 == 0) {
                if (stroke.empty())
                    stroke.push_back(at(done));
                stroke.push_back(at(done + step));
            }
            done += step;
            remaining -= step;
            if (remaining > 0)
                continue;
            end_stroke();
            dash = (dash + 1) % dashes.size();
            remaining = dashes[dash] * width;
        }
    }
    end_stroke();
}

void draw_marker(ImVec2 at, int marker, float radius, ImU32 colour) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float r = radius;
    switch (marker % line_markers) {
    case 0:
        return list.AddCircleFilled(at, r, colour);
    case 1:
        return list.AddRectFilled({at.x - r, at.y - r}, {at.x + r, at.y + r}, colour);
    case 2:
        return list.AddTriangleFilled({at.x, at.y - 1.3f * r}, {at.x + 1.2f * r, at.y + 0.9f * r},
                                      {at.x - 1.2f * r, at.y + 0.9f * r}, colour);
    default:
        return list.AddQuadFilled({at.x, at.y - 1.4f * r}, {at.x + 1.4f * r, at.y}, {at.x, at.y + 1.4f * r},
                                  {at.x - 1.4f * r, at.y}, colour);
    }
}

} // namespace tessera
