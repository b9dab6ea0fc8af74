#include "ui/panels.h"
#include "ui/path_overlay.h"
#include "ui/theme.h"

#include <cstdio>
#include <string>
#include <vector>

namespace tessera {

namespace {

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
constexpr ImGuiTableFlags table_flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollX |
                                        ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerH;

struct Column {
    const char* name;
    const char* help;
};

constexpr Column vertex_columns[] = {
    {"vertex", "x1 is what the camera sees through the pixel."},
    {"position", "In the world, units of the scene."},
    {"BSDF", "What the surface is, as in scene files."},
    {"alpha", "Roughness (no unit): 1 diffuse, 0 perfectly smooth. Above the shift threshold, vertices can be "
              "connected to."},
    {"pdf_w", "Density of the way on, per steradian; after a perfectly smooth scatter (delta) a probability."},
    {"survival", "Probability of the roulette on path length that the path went on (no unit)."},
    {"lamp",
     "Direct light at this vertex by emitter sampling, with its MIS weight: luminance of the radiance toward "
     "the vertex before."},
    {"hit", "The same by BSDF sampling: the way on meets a lamp."},
};
constexpr Column shift_columns[] = {
    {"from", "Pixel whose base path is shifted."},
    {"to", "Pixel that it is shifted to."},
    {"outcome",
     "How the shift ended. own: the pixel's own path; not tried: the path is dark, or the roulette ended "
     "it."},
    {"ratio", "r_m of the light path that brings most: density of the shifted path over the base's, with the "
              "Jacobian (no unit) [Bekaert 2002, Bauszat 2017]."},
    {"weight", "1/R of that light path over the probability of survival (no unit)."},
    {"value", "What the pixel gets of all light paths: luminance of the radiance."},
};

/// Radiance as a luminance.
std::string text(const Rgb& value) {
    char buffer[24];
    std::snprintf(buffer, sizeof buffer, "%.4g", static_cast<double>(luminance(value)));
    return buffer;
}
std::string text(float value) {
    char buffer[24];
    std::snprintf(buffer, sizeof buffer, "%.4g", static_cast<double>(value));
    return buffer;
}
std::string text(glm::ivec2 pixel) {
    return std::to_string(pixel.x) + ", " + std::to_string(pixel.y);
}

template <std::size_t count>
bool begin_table(const char* id, const Column (&columns)[count], float width, Controls& controls) {
    if (!ImGui::BeginTable(id, static_cast<int>(count), table_flags, {width, 0}))
        return false;
    ImGui::TableSetupScrollFreeze(0, 1);
    for (const Column& column : columns)
        ImGui::TableSetupColumn(column.name);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (const Column& column : columns) {
        ImGui::TableNextColumn();
        ImGui::TableHeader(column.name);
        controls.note((std::string(id) + "." + column.name).c_str(), column.help);
    }
    return true;
}

void cell(const std::string& value) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
}

void draw_vertex(const InspectedVertex& x, std::size_t i) {
    char position[64];
    std::snprintf(position, sizeof position, "%.3g %.3g %.3g", static_cast<double>(x.position.x),
                  static_cast<double>(x.position.y), static_cast<double>(x.position.z));
    cell("x" + std::to_string(i + 1));
    cell(position);
    cell(std::string(x.bsdf));
    cell(text(x.roughness));
    cell(!x.goes_on ? "end" : text(x.pdf_w) + (x.is_delta ? " delta" : x.escapes ? " escapes" : ""));
    cell(x.goes_on ? text(x.survival) : "");
    cell(text(x.sampled));
    cell(x.goes_on ? text(x.hit) : "");
}

void draw_vertices(const Inspection& inspection, float width, Controls& controls) {
    if (!begin_table("vertices", vertex_columns, width, controls))
        return;
    for (std::size_t i = 0; i < inspection.path.size(); ++i)
        draw_vertex(inspection.path[i], i);
    ImGui::EndTable();
}

void draw_shift_row(const InspectedShift& s, int row, Inspector& inspector) {
    const bool own = s.from == s.to;
    ImGui::TableNextColumn();
    ImGui::PushID(row);
    ImGui::Selectable(text(s.from).c_str(), inspector.marked == row, ImGuiSelectableFlags_SpanAllColumns);
    if (ImGui::IsItemHovered())
        inspector.marked = row;
    ImGui::PopID();
    cell(text(s.to));
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, s.is_tried ? outcome_colour(s.outcome) : colours::dim_text);
    ImGui::TextUnformatted(!s.is_tried ? "not tried" : own ? "own" : std::string(to_string(s.outcome)).c_str());
    ImGui::PopStyleColor();
    cell(s.ratio > 0 ? text(s.ratio) : "");
    cell(s.weight > 0 ? text(s.weight) : "");
    cell(text(s.value));
}

void draw_shifts(Inspector& inspector, Controls& controls) {
    inspector.marked = ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows) ? inspector.marked : -1;
    if (!begin_table("shifts", shift_columns, 0, controls))
        return;
    const std::vector<const InspectedShift*> shifts = shown_shifts(inspector);
    for (std::size_t i = 0; i < shifts.size(); ++i)
        draw_shift_row(*shifts[i], static_cast<int>(i), inspector);
    ImGui::EndTable();
}

std::string headline(const Inspection& i) {
    std::string line = std::string(paper_name(i.method)) + "   pixel (" + text(i.pixel) + ")   pass " +
                       std::to_string(i.pass) + "   own path " + text(i.radiance);
    for (const InspectedSet& set : i.sets)
        line += "   |   " + std::to_string(set.pixels.size()) + " paths: pixel gets " + text(set.radiance) +
                ", own path " + (set.scale > 0 ? "reused x " + text(set.scale) : "not reused");
    return line + (i.is_refused ? "   REFUSED: not finite" : "");
}

void draw_top_row(Controls& controls, Inspector& inspector) {
    static const std::vector<ChoiceItem> directions = {
        {"to_pixel", "what reaches the pixel", "The base paths of its sampling set, shifted to the pixel."},
        {"from_pixel", "where its path goes", "The pixel's own base path, shifted to the others of its set."},
    };
    int direction = static_cast<int>(inspector.direction);
    const std::string& shown = directions[static_cast<std::size_t>(direction)].label;
    if (controls.bare_choice("inspector.direction", shown.c_str(), directions, direction,
                             ImGui::GetFontSize() * 13, "Which shifts are drawn and listed."))
        inspector.direction = static_cast<Inspector::Direction>(direction);
    ImGui::SameLine();
    ImGui::Checkbox("follow", &inspector.follows);
    controls.note("inspector.follow",
                  "Looks at the newest pass, again and again; else at the one that was the newest "
                  "when the pixel was chosen.");
    ImGui::SameLine();
    if (controls.button("inspector.close", "Close", "Ends the path inspector (I)."))
        inspector.active = false;
    ImGui::SameLine();
    if (inspector.inspection)
        ImGui::TextUnformatted(headline(*inspector.inspection).c_str());
    else
        ImGui::TextDisabled(inspector.sample ? "waiting for the first whole pass" : "click on a pixel");
}

} // namespace

void draw_inspector_panel(const ScreenRect& where, Controls& controls, ViewerState& state) {
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    if (ImGui::Begin("Path inspector", nullptr, flags)) {
        draw_top_row(controls, state.inspector);
        if (state.inspector.inspection) {
            draw_vertices(*state.inspector.inspection, ImGui::GetContentRegionAvail().x * 0.55f, controls);
            ImGui::SameLine();
            draw_shifts(state.inspector, controls);
        }
    }
    ImGui::End();
}

} // namespace tessera
