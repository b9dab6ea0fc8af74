#include "render/inspect/inspection.h"
#include "ui/gl/theme.h"
#include "ui/inside/drawing.h"
#include "ui/inside/inside.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <glm/vec2.hpp>

namespace tessera {

namespace {

constexpr ImU32 veil_colour = IM_COL32(0, 0, 0, 150), part_colour = IM_COL32(255, 255, 255, 120);
constexpr ImU32 tile_colour = IM_COL32(255, 255, 255, 230), shadow_colour = IM_COL32(0, 0, 0, 200);
constexpr ImU32 base_colour = IM_COL32(255, 255, 255, 255), skipped_colour = IM_COL32(255, 196, 92, 255);

class SlowDrawing {
public:
    SlowDrawing(const PictureFrame& frame, const ViewerState& state)
        : slow_(state.slow_motion), tone_(state.display.tone), size_(state.request_size()), drawing_(frame, size_),
          place_(slow_.place()), line_(std::max(ImGui::GetFontSize() / 8, 1.0f)) {}

    void draw() const {
        for (int i = 0; i < place_.set; ++i)
            fill(slow_.tile->sets[i], -1);
        // The current base path is included once its arrows have arrived.
        const bool has_arrived = slow_.arrived >= 1 || slow_.current >= slow_.tile->base_count();
        fill(set(), place_.base + (has_arrived ? 1 : 0));
        draw_parts();
        draw_arrows();
        drawing_.outline(set(), true, set_colours::border, line_ * 1.3f);
        drawing_.outline(set(), false, set_colours::inner, line_ * 1.3f);
        mark_base();
        draw_numbers();
    }

private:
    const InspectedSet& set() const { return slow_.set(); }

    /// Fills pixels with their radiance from the first `bases` base paths; -1: from all.
    void fill(const InspectedSet& of, int bases) const {
        const int count = bases < 0 ? of.size() : bases;
        for (int m = 0; m < of.size(); ++m) {
            const bool border = of.is_border[m] != 0;
            if (border && bases < 0)
                continue; // it belongs to another tile
            const Rgb c = displayed(of.radiance(m, count), tone_) * (border ? 0.45f : 1.0f);
            drawing_.fill(of.pixels[m], ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1}));
        }
    }

    /// Draws the tile and the sampling sets that it is split into.
    void draw_parts() const {
        for (const InspectedSet& part : slow_.tile->sets)
            drawing_.outline(part, false, part_colour, line_ * 0.6f);
        drawing_.outline(slow_.tile->tile.clipped(size_), tile_colour, line_);
    }

    void draw_arrows() const {
        float most = 0;
        for (int m = 0; m < set().size(); ++m)
            if (m != place_.base)
                most = std::max(most, luminance(shift(m).value));
        const float progress = std::min(slow_.arrived * 1.25f, 1.0f); // then arrows rest for a moment
        for (int m = 0; m < set().size(); ++m) {
            const InspectedShift& s = shift(m);
            if (m == place_.base || !s.is_tried)
                continue;
            const float fraction = most > 0 ? luminance(s.value) / most : 0;
            const bool ok = s.outcome == ShiftOutcome::ok;
            const ImU32 colour = with_alpha(outcome_colour(s), ok ? 0.35f + 0.6f * fraction : 0.5f);
            drawing_.arrow(s.from, s.to, progress, colour, line_ * (0.5f + fraction));
            if (progress >= 1)
                draw_mark(s);
        }
    }

    /// Marks a pixel along its edge, as numbers are drawn inside.
    void draw_mark(const InspectedShift& s) const {
        const ImVec2 a = drawing_.corner(s.to), b = drawing_.corner(s.to + 1);
        const float in = std::max((b.x - a.x) * 0.06f, line_);
        ImGui::GetWindowDrawList()->AddRect({a.x + in, a.y + in}, {b.x - in, b.y - in},
                                            with_alpha(outcome_colour(s), 0.8f), 0, 0, line_ * 0.7f);
    }

    void mark_base() const {
        const ReuseDecision& reuse = set().base(place_.base).reuse;
        const glm::ivec2 pixel = set().pixels[place_.base];
        const ImU32 colour = reuse.survives()  ? base_colour
                             : reuse.is_dark() ? outcome_colour(shift(0))
                                               : skipped_colour;
        drawing_.frame(pixel, shadow_colour, line_ * 3);
        drawing_.frame(pixel, colour, line_ * 2);
        if (reuse.survives())
            return;
        const ImVec2 a = drawing_.corner(pixel), b = drawing_.corner(pixel + 1); // a cross
        const float in = (b.x - a.x) * 0.25f;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        for (const auto& [shade, width] : {std::pair(shadow_colour, line_ * 3), std::pair(colour, line_ * 1.5f)}) {
            list.AddLine({a.x + in, a.y + in}, {b.x - in, b.y - in}, shade, width);
            list.AddLine({a.x + in, b.y - in}, {b.x - in, a.y + in}, shade, width);
        }
    }

    /// Draws the luminance that each pixel receives from this base path, and its weight below, if there is room.
    void draw_numbers() const {
        const float font = std::floor(ImGui::GetFontSize() * 0.8f);
        const float width = mono_font()->CalcTextSizeA(font, 1e6f, 0, "00000").x;
        if (drawing_.unit() < width || slow_.arrived < 0.8f)
            return;
        for (int m = 0; m < set().size(); ++m) {
            const InspectedShift& s = shift(m);
            if (is_black(s.value))
                continue;
            draw_number(s.to, luminance(s.value), true, font);
            if (s.weight > 0)
                draw_number(s.to, s.weight, false, font);
        }
    }

    void draw_number(glm::ivec2 pixel, float number, bool above, float font) const {
        char text[16];
        std::snprintf(text, sizeof text, number >= 99.5f || number < 0.000095f ? "%.0e" : "%.2g",
                      static_cast<double>(number));
        const char* shown = text[0] == '0' && text[1] == '.' ? text + 1 : text;
        const ImVec2 middle = drawing_.middle(pixel);
        const float x = std::floor(middle.x - mono_font()->CalcTextSizeA(font, 1e6f, 0, shown).x * 0.5f);
        const float y =
            std::floor(above ? middle.y - 0.38f * drawing_.unit() : middle.y + 0.38f * drawing_.unit() - font);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        for (const ImVec2 by : {ImVec2(1, 1), ImVec2(-1, 0), ImVec2(1, 0), ImVec2(0, -1)})
            list.AddText(mono_font(), font, {x + by.x, y + by.y}, shadow_colour, shown);
        list.AddText(mono_font(), font, {x, y}, above ? base_colour : IM_COL32(190, 200, 214, 255), shown);
    }

    const InspectedShift& shift(int m) const { return set().shift(place_.base, m); }

    const SlowMotion& slow_;
    const Tone& tone_;
    glm::ivec2 size_;
    SetDrawing drawing_;
    SlowMotion::Place place_;
    float line_;
};

} // namespace

bool has_slow_motion(const ViewerState& state) {
    const SlowMotion& slow = state.slow_motion;
    const PaneState* pane = state.pane_in(slow.slot);
    return slow.active && slow.tile && !slow.tile->sets.empty() && pane && slow.generation == pane->generation;
}

bool shows_slow_motion(int pane, const ViewerState& state) {
    return has_slow_motion(state) && state.panes[pane].slot == state.slow_motion.slot;
}

std::vector<float> slow_motion_luminances(const SlowMotion& slow) {
    std::vector<float> luminances;
    for (const InspectedSet& set : slow.tile->sets)
        for (int m = 0; m < set.size(); ++m)
            if (!set.is_border[m]) // border pixels belong to another tile
                luminances.push_back(luminance(set.radiance(m, set.size())));
    return luminances;
}

void draw_slow_motion(const PictureFrame& frame, const ScreenRect& clip, int pane, const ViewerState& state) {
    if (!shows_slow_motion(pane, state))
        return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({clip.min.x, clip.min.y}, {clip.max.x, clip.max.y}, true);
    list.AddRectFilled({clip.min.x, clip.min.y}, {clip.max.x, clip.max.y}, veil_colour);
    SlowDrawing(frame, state).draw();
    list.PopClipRect();
}

} // namespace tessera
