#include "ui/gl/gui.h"
#include "ui/gl/theme.h"
#include "ui/panels/panels.h"
#include "ui/settings/thumbnails.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <imgui.h>

namespace tessera {

namespace {

namespace fs = std::filesystem;
constexpr float card_width = 10.5f; // font sizes

/// Opens a scene file; empty: the built-in scene.
void open(const std::filesystem::path& file, ViewerState& state) {
    if (file.empty())
        state.wishes.open_built_in = true;
    else
        state.wishes.open_scene = file.string();
}

/// Returns the entries of recent scenes, with their stored thumbnails.
std::vector<GalleryEntry> recent_entries(const std::vector<std::string>& scenes, const fs::path& preferences) {
    std::vector<GalleryEntry> entries;
    for (const std::string& scene : scenes) {
        const fs::path file = scene;
        entries.push_back({(file.parent_path().filename() / file.filename()).string(), scene, "", false, file,
                           preferences.empty() ? RgbImage() : read_thumbnail(preferences, scene)});
    }
    return entries;
}

/// Draws a table of errors; nothing if it has no rows.
void draw_errors(const ErrorTable& table) {
    if (table.rows.empty() || !ImGui::BeginTable("errors", static_cast<int>(table.columns.size()),
                                                 ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersInnerH))
        return;
    for (const std::string& column : table.columns)
        ImGui::TableSetupColumn(column.c_str());
    ImGui::TableHeadersRow();
    for (const auto& row : table.rows) {
        for (const ErrorTable::Cell& cell : row) {
            ImGui::TableNextColumn();
            ImGui::PushStyleColor(ImGuiCol_Text, cell.is_worse ? colours::warning : colours::text);
            ImGui::TextUnformatted(cell.text.c_str());
            ImGui::PopStyleColor();
        }
    }
    ImGui::EndTable();
}

/// Draws a dashed frame as a hint. Files can be dropped anywhere on the window.
void draw_drop_target(Controls& controls) {
    constexpr const char* text = "Drop a scene, a picture or a settings file here";
    const float font = ImGui::GetFontSize(), dash = std::floor(font * 0.5f);
    const ImVec2 min = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(ImGui::GetContentRegionAvail().x, font), std::floor(font * 3.2f));
    const ImVec2 max(min.x + size.x - 1, min.y + size.y - 1);
    ImGui::Dummy(size);
    controls.place("gallery.drop",
                   "Opens a Mitsuba scene (.xml), uses a picture (.exr) as the reference that errors are measured "
                   "against, or applies settings or a camera (.json).");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (float x = min.x; x < max.x; x += 2 * dash)
        for (const float y : {min.y, max.y})
            list.AddLine({x, y}, {std::min(x + dash, max.x), y}, colours::dim_text, 1.5f);
    for (float y = min.y; y < max.y; y += 2 * dash)
        for (const float x : {min.x, max.x})
            list.AddLine({x, y}, {x, std::min(y + dash, max.y)}, colours::dim_text, 1.5f);
    const ImVec2 extent = ImGui::CalcTextSize(text);
    list.AddText({std::floor(min.x + (size.x - extent.x) * 0.5f), std::floor(min.y + (size.y - extent.y) * 0.5f)},
                 colours::text, text);
}

} // namespace

void Gallery::Shelf::fill(std::vector<GalleryEntry> with) {
    entries = std::move(with);
    textures = std::vector<GlTexture>(entries.size());
}

void Gallery::draw_card(const std::string& id, const GalleryEntry& entry, GlTexture& texture, Controls& controls,
                        ViewerState& state) {
    const float font = ImGui::GetFontSize(), width = std::floor(font * card_width);
    const ImVec2 picture(width, std::floor(width * 0.75f));
    const ImVec2 min = ImGui::GetCursorScreenPos();
    const ImVec2 size(width, picture.y + 2.6f * font);
    if (ImGui::InvisibleButton(id.c_str(), size))
        open(entry.file, state);
    const bool hovered = ImGui::IsItemHovered();
    controls.place(id.c_str(), entry.help.c_str(), [&] { draw_errors(entry.errors); });
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end(min.x + picture.x, min.y + picture.y);
    list.AddRectFilled(min, end, IM_COL32(0, 0, 0, 255));
    if (!entry.picture.empty()) {
        if (texture.name() == 0)
            texture.upload(entry.picture);
        list.AddImage(texture_id(texture.name()), min, end);
    }
    list.AddRect(min, end, hovered ? colours::accent : colours::line, 0, 0, hovered ? 2.0f : 1.0f);
    list.AddText({min.x, end.y + font * 0.2f}, colours::text, entry.title.c_str());
    list.AddText({min.x, end.y + font * 1.3f}, entry.is_worse ? colours::warning : colours::dim_text,
                 entry.verdict.c_str());
}

void Gallery::draw_cards(const std::string& prefix, Shelf& shelf, Controls& controls, ViewerState& state) {
    const float width = std::floor(ImGui::GetFontSize() * card_width) + ImGui::GetStyle().ItemSpacing.x;
    const auto columns = static_cast<std::size_t>(std::max(1.0f, ImGui::GetContentRegionAvail().x / width));
    for (std::size_t i = 0; i < shelf.entries.size(); ++i) {
        const GalleryEntry& entry = shelf.entries[i];
        draw_card(prefix + (prefix.ends_with('/') ? entry.title : std::to_string(i)), entry, shelf.textures[i],
                  controls, state);
        if (i % columns != columns - 1 && i + 1 < shelf.entries.size())
            ImGui::SameLine();
    }
}

void Gallery::take_entries(ViewerState& state, const Sources& sources) {
    if (sources.maker)
        job_.ask(0, [maker = sources.maker](const std::stop_token&) { return maker(); }, sources.wake);
    if (auto outcome = job_.take()) {
        const std::string& problem = outcome->result ? outcome->result->problem : outcome->error;
        if (!problem.empty())
            state.add_message(Message::Kind::error, "Gallery: " + problem);
        scenes_.fill(outcome->result ? std::move(outcome->result->entries) : std::vector<GalleryEntry>());
    }
    recent_job_.ask(
        {state.scene_info.recent, sources.thumbnails_stored},
        [scenes = state.scene_info.recent, preferences = sources.preferences](const std::stop_token&) {
            return recent_entries(scenes, preferences);
        },
        sources.wake);
    if (auto outcome = recent_job_.take(); outcome && outcome->result)
        recent_.fill(std::move(*outcome->result));
}

void Gallery::draw(const ScreenRect& where, Controls& controls, ViewerState& state, const Sources& sources) {
    take_entries(state, sources);
    ImGui::SetNextWindowPos(
        {where.min.x, where.min.y}); // covers all pictures: visible parts of them would distract
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    if (ImGui::Begin("Gallery", nullptr, overlay_flags)) {
        heading("Scenes");
        if (controls.button("gallery.open", "Open a scene ...", "Chooses a Mitsuba scene (.xml) (Ctrl+O)."))
            state.layout.choosing = FilePurpose::scene;
        ImGui::SameLine();
        if (controls.button("gallery.close", "Close", "Closes the gallery (Esc). Ctrl+G opens it again."))
            state.layout.show_gallery = false;
        draw_drop_target(controls);
        ImGui::BeginChild("scenes");
        if (!recent_.entries.empty()) {
            heading("Recent");
            draw_cards("gallery.recent", recent_, controls, state);
        }
        heading("Built-in scene, and scenes on which methods are known to fail");
        draw_cards("gallery/", scenes_, controls, state);
        ImGui::EndChild();
    }
    ImGui::End();
}

} // namespace tessera
