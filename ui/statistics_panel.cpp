#include "ui/panels.h"
#include "ui/statistics.h"
#include "ui/theme.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <imgui.h>

namespace tessera {

namespace {

// Where a row's columns end, as fractions of its width.
constexpr float value_end = 0.60f;
constexpr float share_end = 0.79f;

std::string per_cent(double share) {
    char text[16];
    std::snprintf(text, sizeof text, "%.1f %%", share * 100);
    return text;
}

void draw_right_aligned(ImDrawList& list, float right, float y, ImU32 colour, const std::string& text) {
    list.AddText({std::floor(right - ImGui::CalcTextSize(text.c_str()).x), y}, colour, text.c_str());
}

/// The share as a bar in the last column.
void draw_bar(ImDrawList& list, ImVec2 min, ImVec2 max, double share, ImU32 colour) {
    const float filled = min.x + (max.x - min.x) * static_cast<float>(std::clamp(share, 0.0, 1.0));
    list.AddRectFilled(min, max, colours::line);
    list.AddRectFilled(min, {filled, max.y}, colour);
}

void draw_figure(Controls& controls, const Figure& figure, ImU32 bar_colour) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f), height = ImGui::GetTextLineHeight();
    ImGui::Dummy({width, height});
    controls.note(("statistics." + figure.id).c_str(), figure.help.c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText(at, colours::dim_text, figure.label.c_str());
    draw_right_aligned(list, at.x + width * value_end, at.y, colours::text, figure.value);
    if (!figure.share)
        return;
    draw_right_aligned(list, at.x + width * share_end, at.y, colours::text, per_cent(*figure.share));
    const float thickness = std::floor(height * 0.3f), top = at.y + std::floor((height - thickness) * 0.5f) + 1;
    draw_bar(list, {at.x + width * (share_end + 0.03f), top}, {at.x + width, top + thickness}, *figure.share,
             bar_colour);
}

void draw_refused(Controls& controls, const Snapshot& snapshot) {
    const std::string text = refused_text(snapshot.counters, snapshot.settings.seed);
    if (text.empty())
        return;
    ImGui::Spacing();
    ImGui::PushStyleColor(ImGuiCol_Text, colours::warning);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    controls.note("statistics.refused",
                  "Pass and pixel count from 0. With the seed, the first of them can be traced "
                  "again.");
}

void draw_contents(Controls& controls, const Snapshot& snapshot) {
    const ImU32 colour = method_colour(snapshot.settings.method);
    for (const FigureGroup& group : statistics(snapshot)) {
        heading(group.title.c_str());
        for (const Figure& figure : group.figures)
            draw_figure(controls, figure, colour);
    }
    draw_refused(controls, snapshot);
}

} // namespace

void draw_statistics_panel(const ScreenRect& where, Controls& controls, const ViewerState& state) {
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                        {ImGui::GetStyle().ItemSpacing.x, std::floor(ImGui::GetFontSize() * 0.15f)});
    if (ImGui::Begin("Statistics", nullptr, side_panel_flags)) {
        ImGui::GetWindowDrawList()->AddLine({where.min.x, where.min.y}, {where.max.x, where.min.y}, colours::line);
        const PaneState& pane = state.active();
        if (pane.snapshot)
            draw_contents(controls, *pane.snapshot);
        else
            ImGui::TextDisabled("no samples yet");
    }
    ImGui::End();
    ImGui::PopStyleVar();
}

} // namespace tessera
