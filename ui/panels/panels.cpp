#include "ui/panels/panels.h"

#include "ui/gl/theme.h"
#include "ui/panes/pane_parts.h"
#include "ui/state/actions.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fmt/core.h>
#include <imgui.h>

namespace tessera {

namespace {

void draw_recent_scenes(Controls& controls, ViewerState& state) {
    if (!state.scene_info.recent.empty())
        ImGui::Separator();
    for (std::size_t i = 0; i < state.scene_info.recent.size(); ++i) {
        const std::string& file = state.scene_info.recent[i];
        const std::filesystem::path path(file);
        const std::string name = (path.parent_path().filename() / path.filename()).string();
        if (ImGui::MenuItem((name + "##recent" + std::to_string(i)).c_str()))
            state.wishes.open_scene = file;
        controls.place(("menu File/recent " + std::to_string(i)).c_str(), ("Opens " + file).c_str());
    }
}

void draw_menu(Controls& controls, const char* menu, ViewerState& state) {
    const bool open = ImGui::BeginMenu(menu);
    controls.place((std::string("menu ") + menu).c_str(), nullptr);
    if (!open)
        return;
    for (const Action& action : actions()) {
        if (std::strcmp(action.menu, menu) == 0)
            draw_menu_item(std::string("menu ") + menu, action, controls, state);
    }
    if (std::strcmp(menu, "File") == 0)
        draw_recent_scenes(controls, state);
    ImGui::EndMenu();
}

/// Returns the name, with dots in place of its beginning if it is wider than `width`.
std::string shortened(const std::string& name, float width) {
    const auto fits = [&](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x <= width; };
    if (name.empty() || fits(name)) // even an empty name does not fit a negative width
        return name;
    std::size_t cut = 1;
    while (cut < name.size() && (!fits("..." + name.substr(cut)) || (name[cut] & 0xc0) == 0x80))
        ++cut; // never inside a UTF-8 sequence
    return "..." + name.substr(cut);
}

/// Draws an item of the menu bar with the progress of a task. Returns whether it was clicked.
/// @param share  fraction of the task that is done, [0, 1]
bool progress_item(const char* id, const char* task, float share, const char* help, Controls& controls) {
    char text[64];
    std::snprintf(text, sizeof text, "%s %.0f %%###%s", task, static_cast<double>(100 * share), id);
    ImGui::PushStyleColor(ImGuiCol_Text, colours::accent);
    const bool clicked = ImGui::MenuItem(text);
    ImGui::PopStyleColor();
    controls.place(id, help);
    return clicked;
}

/// Draws the progress of reading a reference and of rendering one.
void draw_references_under_way(Controls& controls, ViewerState& state) {
    if (state.reference_read && progress_item("reading", "Reading reference", *state.reference_read,
                                              "A reference is being read. Click to cancel (Esc); the present "
                                              "reference stays.",
                                              controls))
        state.wishes.cancel_reference = true;
    const auto& making = state.reference_making.progress;
    if (making && progress_item("making", "Reference", static_cast<float>(making->share()),
                                "A reference is being rendered. Click to show or hide its progress.", controls))
        state.reference_making.show = !state.reference_making.show;
}

/// Draws the right end of the menu bar: the scene's name, and a button for the messages if there are any.
void draw_menu_bar_end(Controls& controls, ViewerState& state) {
    const std::size_t count = state.messages.size();
    const bool errors = std::any_of(state.messages.begin(), state.messages.end(),
                                    [](const Message& m) { return m.kind == Message::Kind::error; });
    const char* icon = errors ? icons().warning : icons().note;
    const std::string button =
        std::string(icon) + (*icon ? " " : "") + std::to_string(count) + (count == 1 ? " message" : " messages");
    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    const float button_width = count > 0 ? ImGui::CalcTextSize(button.c_str()).x + 3 * spacing : 0;
    const float room = ImGui::GetWindowWidth() - ImGui::GetCursorPosX() - button_width - 2 * spacing;
    const std::string name = shortened(state.scene_info.name, room);
    const float x = ImGui::GetCursorPosX() + room - ImGui::CalcTextSize(name.c_str()).x;
    if (x > ImGui::GetCursorPosX())
        ImGui::SetCursorPosX(x);
    ImGui::TextDisabled("%s", name.c_str());
    controls.place("scene_name", ("Scene: " + state.scene_info.name).c_str());
    if (count == 0)
        return;
    ImGui::PushStyleColor(ImGuiCol_Text, errors ? colours::error : colours::dim_text);
    if (ImGui::MenuItem((button + "##messages").c_str()))
        state.layout.show_messages = !state.layout.show_messages;
    ImGui::PopStyleColor();
    controls.place("messages", "Shows or hides the messages (F2).");
}

/// Draws the button that opens the samples of a message, one per click.
void draw_inspect_button(Message& message, int index, Controls& controls, ViewerState& state) {
    const std::size_t count = message.samples.size();
    const SampleChoice& next = message.samples[message.next_sample];
    const std::string label =
        count == 1 ? "Inspect" : fmt::format("Inspect {} of {}", message.next_sample + 1, count);
    const std::string help =
        fmt::format("Opens the sample of pixel ({}, {}) in the path inspector.{}", next.pixel.x, next.pixel.y,
                    count == 1 ? "" : " The next click opens the next sample. F2 shows the messages again.");
    if (controls.button(("inspect_message" + std::to_string(index)).c_str(), label.c_str(), help.c_str())) {
        state.inspect(next);
        message.next_sample = (message.next_sample + 1) % count;
    }
    ImGui::SameLine();
}

void draw_message(Message& message, int index, Controls& controls, ViewerState& state) {
    const bool error = message.kind == Message::Kind::error;
    const char* icon = error ? icons().warning : icons().note;
    ImGui::PushStyleColor(ImGuiCol_Text, error ? colours::error : colours::dim_text);
    ImGui::TextUnformatted(*icon ? icon : error ? "error" : "note");
    ImGui::PopStyleColor();
    ImGui::SameLine();
    if (!message.samples.empty())
        draw_inspect_button(message, index, controls, state);
    ImGui::PushFont(mono_font());
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(message.text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
}

} // namespace

float draw_menu_bar(Controls& controls, ViewerState& state) {
    if (!ImGui::BeginMainMenuBar())
        return 0;
    const char* previous = "";
    for (const Action& action : actions()) {
        if (is_in_menu(action) && std::strcmp(action.menu, previous) != 0)
            draw_menu(controls, action.menu, state);
        previous = action.menu;
    }
    draw_references_under_way(controls, state);
    draw_menu_bar_end(controls, state);
    const float height = ImGui::GetWindowHeight();
    ImGui::EndMainMenuBar();
    return height;
}

void draw_message_panel(const ScreenRect& where, Controls& controls, ViewerState& state) {
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    if (ImGui::Begin("Messages", nullptr, overlay_flags)) {
        if (controls.button("clear_messages", "Clear", "Deletes all messages.")) {
            state.messages.clear();
            state.layout.show_messages = false;
        }
        ImGui::SameLine();
        if (controls.button("hide_messages", "Hide", "Hides the list. F2 shows it again."))
            state.layout.show_messages = false;
        // The list scrolls separately, so that the buttons stay in place.
        ImGui::BeginChild("list");
        int index = 0;
        for (Message& message : state.messages)
            draw_message(message, index++, controls, state);
        if (std::exchange(state.wishes.scroll_to_newest, false))
            ImGui::SetScrollHereY(1.0f);
        ImGui::EndChild();
    }
    ImGui::End();
}

void draw_loading(const ScreenRect& where, Controls& controls, ViewerState& state, const std::string& what,
                  const LoadProgress::State& progress, double seconds) {
    char time[32];
    std::snprintf(time, sizeof time, " ...  %.1f s", seconds);
    const std::string text = "Loading " + what + time + "\n" + to_string(progress);
    const ImVec2 text_size = ImGui::CalcTextSize(text.c_str());
    const float pad = ImGui::GetFontSize(), bar_height = std::floor(pad * 0.3f), row = ImGui::GetFrameHeight();
    const glm::vec2 half(text_size.x * 0.5f + pad, (text_size.y + row) * 0.5f + 1.5f * pad + bar_height);
    const glm::vec2 center = (where.min + where.max) * 0.5f;
    const ImVec2 min(center.x - half.x, center.y - half.y), max(center.x + half.x, center.y + half.y);
    ImGui::SetNextWindowPos(min);
    ImGui::SetNextWindowSize({max.x - min.x, max.y - min.y});
    if (ImGui::Begin("Loading", nullptr, overlay_flags | ImGuiWindowFlags_NoBackground)) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled(min, max, colours::overlay, pad * 0.5f);
        list.AddRect(min, max, colours::overlay_line, pad * 0.5f);
        list.AddText({min.x + pad, min.y + pad}, colours::overlay_text, text.c_str());
        ImGui::SetCursorScreenPos({min.x + pad, min.y + 1.5f * pad + text_size.y});
        if (controls.button("cancel_load", "Cancel", "Cancels the load (Esc). The present scene stays."))
            state.wishes.cancel_scene = true;
        if (progress.total > 0) {
            const float share = static_cast<float>(progress.done) / static_cast<float>(progress.total);
            const float left = min.x + pad, right = max.x - pad, bottom = max.y - pad * 0.5f;
            list.AddRectFilled({left, bottom - bar_height}, {right, bottom}, colours::overlay_line);
            list.AddRectFilled({left, bottom - bar_height}, {left + share * (right - left), bottom},
                               colours::overlay_accent);
        }
    }
    ImGui::End();
}

void draw_panel_edge(const ScreenRect& pictures, Controls& controls, ViewerState& state) {
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground |
                                       ImGuiWindowFlags_NoNav;
    const float line = ImGui::GetFontSize(), width = std::max(line * 0.4f, 4.0f); // wide enough to grab
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
        state.layout.panel_width = std::clamp((ImGui::GetIO().DisplaySize.x - ImGui::GetIO().MousePos.x) / line,
                                              Layout::least_panel_width, Layout::most_panel_width);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        state.layout.panel_width = Layout().panel_width;
    controls.place("panel edge", "Drag to set the width of the panels. Double-click for the default width.");
    ImGui::End();
}

} // namespace tessera
