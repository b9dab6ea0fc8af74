#include "render/inspect/inspection.h"
#include "render/scene/scene.h"
#include "ui/gl/theme.h"
#include "ui/inside/drawing.h"
#include "ui/inside/inside.h"
#include "ui/state/inspected.h"
#include "ui/state/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

namespace {

void draw_controls(Controls& controls, ViewerState& state) {
    SlowMotion& slow = state.slow_motion;
    const float wide = ImGui::GetFontSize() * 4;
    if (controls.button("slow.hold", slow.held ? "Play" : "Hold",
                        "Plays the base paths one after the other, or pauses (Shift+Space).", wide))
        slow.held = !slow.held;
    ImGui::SameLine();
    if (controls.button("slow.back", "<", "Steps back one base path and pauses (<)."))
        slow.step(-1);
    ImGui::SameLine();
    if (controls.button("slow.step", ">", "Steps forward one base path and pauses (>)."))
        slow.step(1);
    ImGui::SameLine();
    if (controls.button("slow.tile", "Next tile",
                        "Shows the next tile to the right, in the newest pass (Shift+J)."))
        slow.start({slow.slot, slow.tile ? slow.next_pixel(state.request_size()) : glm::ivec2(0), {}});
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9);
    ImGui::SliderFloat("##slow.speed", &slow.speed, SlowMotion::least_speed, SlowMotion::most_speed,
                       "%.3g paths a second", ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    controls.place("slow.speed", "Base paths per second.");
    ImGui::SameLine();
    if (controls.button("slow.close", "Close", "Ends the slow motion (J)."))
        slow.active = false;
}

std::string rect_text(const PixelRect& r) {
    return std::to_string(r.width()) + " x " + std::to_string(r.height()) + " pixels at (" + std::to_string(r.x0) +
           ", " + std::to_string(r.y0) + ")";
}

/// Returns for example "G-PR, pass 12:  tile of 6 x 6 pixels at (120, 54), part 2 of 4:  16 base paths, 7 of them
/// from its border".
std::string tile_text(const SlowMotion& slow) {
    const TileInspection& tile = *slow.tile;
    const InspectedSet& set = slow.set();
    const auto border = std::count(set.is_border.begin(), set.is_border.end(), 1);
    const RenderSettings& settings = tile.settings;
    const bool rooks = settings.method == Method::pr && settings.pattern == Pattern::rooks;
    std::string text = std::string(paper_name(settings.method)) + ", pass " + std::to_string(tile.pass) + ":  ";
    text += reuses_paths(settings.method) ? "tile of " + rect_text(tile.tile)
                                          : "pixel (" + short_text(glm::ivec2(tile.tile.x0, tile.tile.y0)) + ")";
    if (tile.sets.size() > 1)
        text += std::string(rooks                           ? ", N-rooks pattern "
                            : reuses_paths(settings.method) ? ", part "
                                                            : ", gradient ") +
                std::to_string(slow.place().set + 1) + " of " + std::to_string(tile.sets.size());
    text += ":  " + std::to_string(set.size()) + " base paths";
    return border > 0 ? text + ", " + std::to_string(border) + " of them from its border" : text;
}

/// Returns for example "Base path 5 of 49, pixel (123, 57):  carries 0.21;  reused (q = 1)".
std::string base_text(const SlowMotion& slow) {
    const InspectedSet& set = slow.set();
    const int k = slow.place().base;
    const InspectedBase& base = set.base(k);
    const ReuseDecision& reuse = base.reuse;
    const std::string text = "Base path " + std::to_string(k + 1) + " of " + std::to_string(set.size()) +
                             ", pixel (" + short_text(set.pixels[k]) + "):  ";
    if (reuse.is_dark())
        return text + (is_black(base.radiance) ? "dark, no light to reuse" : "its light is not reused");
    return text + "carries " + short_text(base.radiance) +
           (!reuse.survives()     ? ";  skipped by the roulette (q = " + short_text(reuse.survival) + ")"
            : reuse.survival >= 1 ? ";  reused (q = 1)"
                                  : ";  reused: survives the roulette with q = " + short_text(reuse.survival) +
                                        ", weight x " + short_text(reuse.scale));
}

/// Draws the number of shifts of the base path with each outcome, in the outcomes' colours.
void draw_outcomes(const InspectedSet& set, int k) {
    std::array<int, shift_outcome_count> counts{};
    for (int m = 0; m < set.size(); ++m)
        if (m != k && set.shift(k, m).is_tried)
            ++counts[static_cast<std::size_t>(set.shift(k, m).outcome)];
    int all = 0;
    for (int n : counts)
        all += n;
    if (all == 0) {
        ImGui::TextDisabled(set.size() > 1 ? "no shift was tried" : "no other pixel in the set");
        return;
    }
    ImGui::Text("%d of %d shifts succeed", counts[0], all);
    const float font = ImGui::GetFontSize();
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] == 0)
            continue;
        ImGui::SameLine(0, font);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddCircleFilled({at.x + font * 0.3f, at.y + font * 0.55f}, font * 0.28f,
                                                    outcome_colour(static_cast<ShiftOutcome>(i)), 12);
        ImGui::SetCursorScreenPos({at.x + font * 0.8f, at.y});
        ImGui::Text("%s %d", label_of_identifier(to_string(static_cast<ShiftOutcome>(i))).c_str(), counts[i]);
    }
}

/// Returns the radiance that the base path contributes to its own pixel and to the others, and its weights.
std::string contribution_text(const InspectedSet& set, int k) {
    Rgb others(0);
    float least = 0, most = 0;
    for (int m = 0; m < set.size(); ++m) {
        const InspectedShift& s = set.shift(k, m);
        if (m == k || s.weight <= 0)
            continue;
        others += s.value;
        least = least > 0 ? std::min(least, s.weight) : s.weight;
        most = std::max(most, s.weight);
    }
    std::string text =
        "Own pixel gets " + short_text(set.shift(k, k).value) + ", the others together " + short_text(others);
    if (most > 0)
        text += ";  weights " + short_text(least) + (most > least ? " .. " + short_text(most) : "");
    return text;
}

void draw_explanation(const ViewerState& state, Controls& controls) {
    const SlowMotion& slow = state.slow_motion;
    const InspectedSet& set = slow.set();
    const int k = slow.place().base;
    ImGui::TextUnformatted(tile_text(slow).c_str());
    controls.place("slow.tile_text",
                   "The pixels that reuse each other's base paths. White: the tile; turquoise: pixels that "
                   "receive radiance here; orange: the border, which takes part and belongs to another tile.");
    ImGui::TextUnformatted(base_text(slow).c_str());
    controls.place("slow.base_text",
                   "The current base path, with a white frame around its pixel. Orange and crossed out: "
                   "skipped by the roulette on reuse; grey: it has no light.");
    draw_outcomes(set, k);
    if (!set.base(k).reuse.survives())
        return;
    ImGui::TextUnformatted(contribution_text(set, k).c_str());
    controls.place("slow.contribution_text",
                   "Luminance of the radiance that pixels receive from this base path. The weight is that of its "
                   "brightest light path: 1 / (sum of the ratios r_m over the sampling set), divided by the "
                   "survival probability. In the pixels: luminance above, weight below.");
}

/// Draws a bar with one field for each base path of the tile: reused, skipped or dark; faint if not yet reached.
void draw_progress(const SlowMotion& slow, float width) {
    const int count = slow.tile->base_count();
    const float height = std::floor(ImGui::GetFontSize() * 0.5f), step = width / static_cast<float>(count);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    int n = 0;
    for (const InspectedSet& set : slow.tile->sets)
        for (const InspectedBase& base : set.bases) {
            const ImU32 colour = base.reuse.survives()  ? outcome_colour(ShiftOutcome::ok)
                                 : base.reuse.is_dark() ? outcome_colour(ShiftOutcome::no_light)
                                                        : IM_COL32(255, 196, 92, 255);
            const float x = at.x + step * static_cast<float>(n), gap = step > 3 ? 1.0f : 0.0f;
            list.AddRectFilled({x, at.y}, {x + step - gap, at.y + height},
                               with_alpha(colour, n <= slow.current ? 1 : 0.25f));
            ++n;
        }
    ImGui::Dummy({width, height});
}

} // namespace

void draw_slow_motion_panel(const ScreenRect& where, Controls& controls, ViewerState& state) {
    const SlowMotion& slow = state.slow_motion;
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    if (ImGui::Begin("Slow motion", nullptr, overlay_flags | ImGuiWindowFlags_NoScrollWithMouse)) {
        draw_controls(controls, state);
        if (!has_slow_motion(state)) {
            ImGui::TextDisabled("waiting for the first whole pass");
        } else {
            const ImVec2 room = ImGui::GetContentRegionAvail();
            const float space = std::min(room.y * 1.6f, room.x * 0.38f);
            ImGui::BeginChild("slow.story", {room.x - space - ImGui::GetStyle().ItemSpacing.x, 0});
            draw_progress(slow, ImGui::GetContentRegionAvail().x);
            controls.place("slow.progress",
                           "All base paths of the tile: green: reused; orange: skipped by the roulette; "
                           "grey: dark; faint: not yet reached.");
            ImGui::PushTextWrapPos(0);
            draw_explanation(state, controls);
            ImGui::PopTextWrapPos();
            ImGui::EndChild();
            ImGui::SameLine();
            const int k = slow.place().base;
            SpaceSubject subject{slow.set().base(k).path, {}, -1, state.scene->radius()};
            for (int m = 0; m < slow.set().size(); ++m)
                if (m != k)
                    subject.shifts.push_back(&slow.set().shift(k, m));
            draw_space_view({space, room.y}, subject, state.space, controls);
        }
    }
    ImGui::End();
}

} // namespace tessera
