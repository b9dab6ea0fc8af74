#include "ui/gl/theme.h"
#include "ui/panels/found_actions.h"
#include "ui/panels/panels.h"
#include "ui/state/actions.h"

#include <algorithm>
#include <cfloat>
#include <cstring>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

namespace {

void draw_dim(const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colours::dim_text);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void draw_keys(const std::string& keys) {
    ImGui::PushStyleColor(ImGuiCol_Text, colours::accent);
    ImGui::TextUnformatted(keys.c_str());
    ImGui::PopStyleColor();
}

/// Draws the actions of one menu that contain all words of the text, with a heading.
void draw_group(const char* menu, const std::string& text) {
    std::vector<const Action*> found;
    for (const Action* action : actions_with(text))
        if (std::strcmp(action->menu, menu) == 0)
            found.push_back(action);
    if (found.empty())
        return;
    heading(menu);
    if (!ImGui::BeginTable(menu, 3, ImGuiTableFlags_BordersInnerH))
        return;
    const float font = ImGui::GetFontSize();
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, font * 8);
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, font * 12);
    ImGui::TableSetupColumn("help", ImGuiTableColumnFlags_WidthStretch);
    for (const Action* action : found) {
        const bool has_second = action->second_shortcut != Shortcut{};
        ImGui::TableNextColumn();
        draw_keys(to_string(action->shortcut) + (has_second ? "   " + to_string(action->second_shortcut) : ""));
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(action->name);
        ImGui::TableNextColumn();
        draw_dim(action->help);
    }
    ImGui::EndTable();
}

/// Draws the gestures that contain all words of the text.
void draw_gestures(const std::string& text) {
    std::vector<Gesture> found;
    for (const Gesture& gesture : gestures())
        if (has_words(std::string(gesture.input) + " " + gesture.help, text))
            found.push_back(gesture);
    if (found.empty())
        return;
    heading("Mouse and held keys");
    if (!ImGui::BeginTable("gestures", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersInnerH))
        return;
    ImGui::TableSetupColumn("input");
    ImGui::TableSetupColumn("help", ImGuiTableColumnFlags_WidthStretch);
    for (const Gesture& gesture : found) {
        ImGui::TableNextColumn();
        draw_keys(gesture.input);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(gesture.help);
    }
    ImGui::EndTable();
}

} // namespace

void HelpPage::draw(glm::vec2 screen, Controls& controls, ViewerState& state) {
    const float font = ImGui::GetFontSize();
    const glm::vec2 size(std::min(screen.x, font * 56), std::min(screen.y, font * 50));
    ImGui::SetNextWindowPos({(screen.x - size.x) * 0.5f, (screen.y - size.y) * 0.5f});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetColorU32(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, font * 0.5f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    if (ImGui::Begin("Help", nullptr, overlay_flags)) {
        ImGui::SetNextItemWidth(-FLT_MIN);
        ImGui::InputTextWithHint("##help.text", "Find a key or a command", text_.data(), text_.size());
        controls.place("help.text",
                       "Type words in any order to filter the page. Ctrl+Shift+P finds a command and runs it.");
        // The page scrolls separately, so that field and button stay in place.
        ImGui::BeginChild("page", {0, -ImGui::GetFrameHeightWithSpacing()});
        const char* previous = "";
        for (const Action& action : actions()) {
            if (std::strcmp(action.menu, previous) != 0)
                draw_group(action.menu, text_.data());
            previous = action.menu;
        }
        draw_gestures(text_.data());
        ImGui::EndChild();
        if (controls.button("close_help", "Close", "Closes this page (F1, ? or Esc)."))
            state.layout.show_help = false;
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

} // namespace tessera
