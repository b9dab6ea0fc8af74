#include "ui/panels.h"
#include "ui/theme.h"

#include <algorithm>

#include <imgui.h>

namespace tessera {

void draw_panel_edge(const ScreenRect& pictures, Controls& controls, ViewerState& state) {
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground |
                                       ImGuiWindowFlags_NoNav;
    const float line = ImGui::GetFontSize(), width = std::max(line * 0.4f, 4.0f); // wide enough to be caught
    const float height = std::max(pictures.size().y, 1.0f);
    ImGui::SetNextWindowPos({pictures.max.x - width / 2, pictures.min.y});
    ImGui::SetNextWindowSize({width, height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin("panel edge", nullptr, flags);
    ImGui::PopStyleVar(2);
    ImGui::InvisibleButton("edge", {width, height});
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        ImGui::GetWindowDrawList()->AddLine({pictures.max.x, pictures.min.y}, {pictures.max.x, pictures.max.y},
                                            colours::accent);
    }
    if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.x != 0)
        state.panel_width = std::clamp((ImGui::GetIO().DisplaySize.x - ImGui::GetIO().MousePos.x) / line,
                                       ViewerState::least_panel_width, ViewerState::most_panel_width);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        state.panel_width = ViewerState().panel_width;
    controls.note("panel edge", "Drag: how wide the panels are. Double click: as at first.");
    ImGui::End();
}

} // namespace tessera
