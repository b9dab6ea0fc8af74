#include "ui/gl/theme.h"
#include "ui/panels/panels.h"

#include <algorithm>

#include <imgui.h>

namespace tessera {

void draw_no_scene(const ScreenRect& where, Controls& controls, ViewerState& state) {
    const float font = ImGui::GetFontSize(), width = std::min(where.size().x, font * 44);
    ImGui::SetNextWindowPos({(where.min.x + where.max.x) * 0.5f, (where.min.y + where.max.y) * 0.5f},
                            ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({width, 0}); // height of the contents
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetColorU32(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, font * 0.5f);
    if (ImGui::Begin("No scene", nullptr, overlay_flags)) {
        heading("There is no scene to render");
        ImGui::PushStyleColor(ImGuiCol_Text, state.scene_info.problem.is_error ? colours::error : colours::text);
        ImGui::PushFont(mono_font()); // messages mark columns in lines of files
        ImGui::TextWrapped("%s", state.scene_info.problem.text.c_str());
        ImGui::PopFont();
        ImGui::PopStyleColor();
        controls.place("no_scene.why", "Reason why the scene could not be loaded.");
        ImGui::Spacing();
        if (controls.button("no_scene.open", "Open a scene ...", "Chooses a Mitsuba scene (.xml) (Ctrl+O)."))
            state.layout.choosing = FilePurpose::scene;
        ImGui::SameLine();
        if (controls.button("no_scene.gallery", "Gallery", "Scenes that come with the program (Ctrl+G)."))
            state.layout.show_gallery = true;
        ImGui::SameLine();
        if (controls.button("no_scene.again", "Try again", "Loads the same scene again (F5)."))
            state.wishes.reload = true;
        dim_text("You can also drop a scene on the window. Recent scenes are in the File menu.");
    }
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

} // namespace tessera
