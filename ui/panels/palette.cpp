#include "ui/gl/theme.h"
#include "ui/panels/found_actions.h"
#include "ui/panels/panels.h"
#include "ui/state/actions.h"

#include <algorithm>
#include <cfloat>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

void CommandPalette::draw(glm::vec2 screen, Controls& controls, ViewerState& state) {
    const bool is_new = state.layout.show_palette && !was_shown_;
    was_shown_ = state.layout.show_palette;
    if (!was_shown_)
        return;
    if (is_new) {
        text_.fill(0);
        chosen_ = 0;
    }
    const float font = ImGui::GetFontSize(), width = std::min(screen.x, font * 40);
    ImGui::SetNextWindowPos({(screen.x - width) * 0.5f, font * 3});
    ImGui::SetNextWindowSize({width, std::min(screen.y - 4 * font, font * 26)});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetColorU32(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, font * 0.5f);
    if (ImGui::Begin("Commands", nullptr, overlay_flags)) {
        if (is_new) {
            ImGui::SetWindowFocus();
            ImGui::SetKeyboardFocusHere();
        }
        ImGui::SetNextItemWidth(-FLT_MIN);
        if (ImGui::InputTextWithHint("##palette", "What do you want to do?", text_.data(), text_.size()))
            chosen_ = 0;
        controls.place(
            "palette.text",
            "Type words in any order to filter the list. Arrow keys choose a command, Return runs it, Esc "
            "closes the list.");
        draw_list(controls, state);
    }
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

void CommandPalette::draw_list(Controls& controls, ViewerState& state) {
    const std::vector<const Action*> found = actions_with(text_.data());
    const int count = static_cast<int>(found.size());
    chosen_ = std::clamp(chosen_ + std::exchange(state.layout.palette_steps, 0), 0, std::max(count - 1, 0));
    const bool takes = std::exchange(state.layout.palette_takes, false);
    const Action* taken = takes && count > 0 ? found[chosen_] : nullptr;
    ImGui::BeginChild("commands");
    for (int i = 0; i < count; ++i) {
        const Action& action = *found[i];
        const std::string label = std::string(action.menu) + "  >  " + action.name;
        if (ImGui::Selectable(label.c_str(), i == chosen_))
            taken = &action;
        if (i == chosen_ && chosen_ != seen_)
            ImGui::SetScrollHereY();
        controls.place(("palette/" + std::string(action.name)).c_str(), action.help);
        const std::string key = to_string(action.shortcut);
        ImGui::SameLine(ImGui::GetWindowWidth() - ImGui::CalcTextSize(key.c_str()).x - ImGui::GetFontSize());
        ImGui::TextDisabled("%s", key.c_str());
    }
    if (count == 0)
        ImGui::TextDisabled("No command contains all these words");
    ImGui::EndChild();
    seen_ = chosen_;
    if (!taken)
        return;
    state.layout.show_palette = false;
    taken->run(state);
}

} // namespace tessera
