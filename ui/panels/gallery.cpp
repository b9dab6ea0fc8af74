#include "ui/gl/gui.h"
#include "ui/gl/theme.h"
#include "ui/panels/panels.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <utility>

#include <imgui.h>

namespace tessera {

namespace {

constexpr float card_width = 10.5f; // heights of a line

/// Empty: the scene within the program.
void open(const std::filesystem::path& file, ViewerState& state) {
    if (file.empty())
        state.wishes.open_built_in = true;
    else
        state.wishes.open_scene = file.string();
}

void draw_recent(Controls& controls, ViewerState& state) {
    if (state.recent_scenes.empty())
        return;
    heading("Recent");
    for (std::size_t i = 0; i < state.recent_scenes.size(); ++i) {
        const std::filesystem::path file = state.recent_scenes[i];
        const std::string name = (file.parent_path().filename() / file.filename()).string();
        if (controls.button(("gallery.recent" + std::to_string(i)).c_str(), name.c_str(), file.string().c_str()))
            open(file, state);
        if (i % 3 != 2 && i + 1 < state.recent_scenes.size())
            ImGui::SameLine();
    }
}

} // namespace

void Gallery::draw_card(std::size_t index, Controls& controls, ViewerState& state) {
    const GalleryEntry& entry = entries_[index];
    const float font = ImGui::GetFontSize(), width = std::floor(font * card_width);
    const ImVec2 picture(width, std::floor(width * 0.75f));
    const ImVec2 min = ImGui::GetCursorScreenPos();
    const ImVec2 size(width, picture.y + 2.6f * font);
    const std::string id = "gallery/" + entry.title;
    if (ImGui::InvisibleButton(id.c_str(), size))
        open(entry.file, state);
    const bool hovered = ImGui::IsItemHovered();
    controls.place(id.c_str(), entry.help.c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end(min.x + picture.x, min.y + picture.y);
    list.AddRectFilled(min, end, IM_COL32(0, 0, 0, 255));
    if (!entry.picture.empty()) {
        GlTexture& texture = textures_[index];
        if (texture.name() == 0)
            texture.upload(entry.picture);
        list.AddImage(texture_id(texture.name()), min, end);
    }
    list.AddRect(min, end, hovered ? colours::accent : colours::line, 0, 0, hovered ? 2.0f : 1.0f);
    list.AddText({min.x, end.y + font * 0.2f}, colours::text, entry.title.c_str());
    list.AddText({min.x, end.y + font * 1.3f}, entry.is_worse ? colours::warning : colours::dim_text,
                 entry.verdict.c_str());
}

void Gallery::draw_cards(Controls& controls, ViewerState& state) {
    const float width = std::floor(ImGui::GetFontSize() * card_width) + ImGui::GetStyle().ItemSpacing.x;
    const auto columns = static_cast<std::size_t>(std::max(1.0f, ImGui::GetContentRegionAvail().x / width));
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        draw_card(i, controls, state);
        if (i % columns != columns - 1 && i + 1 < entries_.size())
            ImGui::SameLine();
    }
}

void Gallery::draw(const ScreenRect& where, Controls& controls, ViewerState& state, const GalleryMaker& maker,
                   const std::function<void()>& wake) {
    if (maker)
        job_.ask(
            0, [maker](const std::stop_token&) { return maker(); }, wake);
    if (auto outcome = job_.take()) {
        if (outcome->result)
            entries_ = std::move(outcome->result->entries);
        const std::string& problem = outcome->result ? outcome->result->problem : outcome->error;
        if (!problem.empty())
            state.add_message(Message::Kind::error, "The gallery: " + problem);
        textures_.resize(entries_.size());
    }
    const float font = ImGui::GetFontSize(), margin = std::floor(font);
    ImGui::SetNextWindowPos({where.min.x + margin, where.min.y + margin});
    ImGui::SetNextWindowSize(
        {std::max(where.size().x - 2 * margin, font), std::max(where.size().y - 2 * margin, font)});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetColorU32(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, font * 0.5f);
    if (ImGui::Begin("Gallery", nullptr, overlay_flags)) {
        heading("Scenes");
        if (controls.button("gallery.open", "Open a scene ...", "Chooses a Mitsuba scene, an .xml file (Ctrl+O)."))
            state.layout.choosing = FilePurpose::scene;
        ImGui::SameLine();
        if (controls.button("gallery.close", "Close", "Shows the pictures (Esc); Ctrl+G shows this again."))
            state.layout.show_gallery = false;
        ImGui::SameLine();
        ImGui::TextDisabled("or drop one on the window");
        ImGui::BeginChild("scenes");
        draw_recent(controls, state);
        heading("The built-in box, and scenes on which methods are known to fail");
        draw_cards(controls, state);
        ImGui::EndChild();
    }
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

} // namespace tessera
