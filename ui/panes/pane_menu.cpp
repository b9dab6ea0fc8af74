#include "ui/panes/pane_parts.h"
#include "ui/state/actions.h"

#include <optional>
#include <span>
#include <string>

#include <glm/vec3.hpp>
#include <imgui.h>

namespace tessera {

std::span<const char* const> pane_menu_items() {
    static constexpr const char* items[] = {"Save picture", "Save as EXR",
                                            nullptr,        "Automatic exposure",
                                            "Fit picture",  "Only the active pane",
                                            nullptr,        "Wipe",
                                            "Difference",   "Compare reconstructions",
                                            nullptr,        "Path inspector",
                                            "Slow motion",  "Bookmark this view"};
    return items;
}

void draw_menu_item(const std::string& menu, const Action& action, Controls& controls, ViewerState& state) {
    const bool checked = action.checked != nullptr && action.checked(state);
    if (ImGui::MenuItem(action.name, to_string(action.shortcut).c_str(), checked))
        action.run(state);
    controls.place((menu + "/" + action.name).c_str(), action.help);
}

void draw_pane_menu(int pane, const PictureFrame& frame, bool is_click, PaneTools& tools) {
    std::optional<glm::vec3>& point = tools.state.layout.menu_point;
    const std::string id = "menu of pane " + std::to_string(pane);
    if (ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Right) && is_click) {
        point = point_under((mouse_position() - frame.rect.min) * frame.pixels_a_unit, frame, tools.state);
        ImGui::OpenPopup(id.c_str());
    }
    if (!ImGui::BeginPopup(id.c_str()))
        return;
    if (ImGui::MenuItem("Look at this", "double click", false, point.has_value()) && point)
        tools.state.camera.focus(*point);
    tools.controls.place("pane_menu/Look at this",
                         "Turns the camera to the surface under the mouse, and orbits around it.");
    for (const char* name : pane_menu_items()) {
        if (name)
            draw_menu_item("pane_menu", action_named(name), tools.controls, tools.state);
        else
            ImGui::Separator();
    }
    ImGui::EndPopup();
}

} // namespace tessera
