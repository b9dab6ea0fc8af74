#include "ui/dialog.h"

#include "ui/controls.h"
#include "ui/panels.h"
#include "ui/theme.h"

#include <algorithm>

namespace tessera {

void draw_dialog(const char* title, glm::vec2 screen, float width, const std::function<void()>& draw) {
    const float font = ImGui::GetFontSize();
    const glm::vec2 size(std::min(screen.x, font * width), 0); // as high as what is in it
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetColorU32(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, font * 0.5f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    if (ImGui::Begin(title, nullptr, overlay_flags & ~ImGuiWindowFlags_NoMove)) {
        heading(title);
        draw();
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

void dim_text(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colours::dim_text);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

} // namespace tessera
