#include "render/inspect/inspection.h"
#include "ui/gl/theme.h"
#include "ui/inside/inside.h"
#include "ui/state/words.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace tessera {

namespace {

constexpr ImGuiTableFlags table_flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollX |
                                        ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerH;

struct Column {
    const char* name;
    const char* help;
};

constexpr Column vertex_columns[] = {
    {"vertex", "x1 is the first vertex that the camera sees; y1, y2, ... are vertices of an offset path. Where it "
               "joins the base path, they are x again."},
    {"BSDF", "Material of the surface, named as in scene files."},
    {"pdf_w",
     "Density of the direction to the next vertex, per steradian; of a delta scatter, its probability. Where "
     "an offset path ends at an emitter: the sum for emitter and BSDF sampling."},
    {"Jacobian",
     "Jacobian of the shift at this vertex: solid angle of the next edge at the offset over that at the base (no "
     "unit) [Kettunen 2015, 5.2; Bekaert 2002]. It is 1 at a delta scatter, beyond the reconnection, and toward "
     "the environment. Full random replay has 1, in the space of random numbers."},
    {"value",
     "Throughput up to here (no unit; luminance): product of f cos / (pdf * survival); for an offset path, f cos "
     "and Jacobian of the offset over pdf and survival of the base. At the end of the light path, times its "
     "emitted radiance."},
    {"ratio", "Density of the offset path up to here, times all Jacobians, over that of the base path (no unit)."},
    {"footprint",
     "Area that the path represents among the samples so far (violet): sides of a parallelogram, scene "
     "units, from the derivatives of the path by its random numbers, limited to 70 % change of the light "
     "[Suykens 2001]. In brackets: side of a square by the scalar form, without that limit. An offset path "
     "has only this, as if its own pixel had sampled it."},
    {"position", "World position, in scene units."},
    {"alpha", "Roughness (no unit): 1 diffuse, 0 perfectly smooth. Vertices above the shift threshold can be "
              "reconnected."},
    {"survival", "Probability of continuing in the Russian roulette on path length (no unit)."},
    {"lamp",
     "Direct light at this vertex by emitter sampling, with its MIS weight: luminance of the radiance toward "
     "the previous vertex."},
    {"hit",
     "The same by BSDF sampling, where the next edge hits an emitter. Emitters seen only in mirrors are not part "
     "of the light path."},
};
constexpr Column shift_columns[] = {
    {"from", "Pixel whose base path is shifted."},
    {"to", "Pixel that it is shifted to."},
    {"outcome",
     "Outcome of the shift. own: the pixel's own path; not tried: the path has no light, or Russian roulette "
     "skipped it. Click to list its vertices."},
    {"Jacobian", "|J| of the brightest light path: the product over its vertices, in "
                 "solid angles (no unit)."},
    {"ratio", "r_m of the brightest light path: density of the offset path over that of the base path, with the "
              "Jacobian (no unit) [Bekaert 2002, Bauszat 2017]."},
    {"weight", "1/R of that light path over the survival probability of the roulette on reuse (no unit)."},
    {"value", "Luminance of the radiance that the pixel receives from all light paths in this set. Of several "
              "sets, the mean counts."},
};

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
        controls.place((std::string(id) + "." + column.name).c_str(), column.help);
    }
    return true;
}

void cell(const std::string& value) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
}

void surface_cells(const DisplayVertex& x) {
    char position[64];
    std::snprintf(position, sizeof position, "%.3g %.3g %.3g", static_cast<double>(x.position.x),
                  static_cast<double>(x.position.y), static_cast<double>(x.position.z));
    cell(position);
    cell(short_text(x.roughness));
}

std::string footprint_text(const InspectedVertex& x) {
    return short_text(glm::length(x.footprint.a)) + " x " + short_text(glm::length(x.footprint.b)) + " (" +
           short_text(x.footprint_width) + ")";
}

void draw_vertex(const InspectedVertex& x, std::size_t i) {
    cell("x" + std::to_string(i + 1));
    cell(std::string(x.bsdf));
    cell(!x.goes_on ? "end" : short_text(x.pdf_w) + (x.is_delta ? " delta" : x.escapes ? " escapes" : ""));
    cell(x.goes_on ? "1" : "");
    cell(x.goes_on ? short_text(x.throughput) : "");
    cell(x.goes_on ? "1" : "");
    cell(x.footprint.area() > 0 ? footprint_text(x) : "");
    surface_cells(x);
    cell(x.goes_on ? short_text(x.survival) : "");
    cell(short_text(x.sampled));
    cell(x.goes_on ? short_text(x.hit) : "");
}

void draw_step(const InspectedStep& y, bool own) {
    const OffsetStep& s = y.shifted;
    cell((own || y.is_joined ? "x" : "y") + std::to_string(s.vertex + 1));
    cell(std::string(y.vertex.bsdf));
    cell(short_text(s.pdf_w) + (s.is_delta ? " delta" : ""));
    cell(short_text(s.jacobian));
    cell(short_text(s.value));
    cell(short_text(s.ratio));
    cell(y.footprint.area() > 0 ? "(" + short_text(glm::length(y.footprint.a)) + ")" : "");
    surface_cells(y.vertex);
    for (int i = 0; i < 3; ++i)
        cell("");
}

const InspectedShift* chosen_shift(const Inspector& inspector) {
    const std::vector<const InspectedShift*> shifts = shown_shifts(inspector);
    const bool is_there = inspector.chosen >= 0 && inspector.chosen < static_cast<int>(shifts.size());
    return is_there ? shifts[inspector.chosen] : nullptr;
}

std::string outcome_text(const InspectedShift& s) {
    return !s.is_tried ? "not tried" : s.from == s.to ? "own" : label_of_identifier(to_string(s.outcome));
}

void draw_shift_row(const InspectedShift& s, int row, Inspector& inspector, Controls& controls) {
    ImGui::TableNextColumn();
    ImGui::PushID(row);
    const bool lit = inspector.marked == row || inspector.chosen == row;
    if (ImGui::Selectable(short_text(s.from).c_str(), lit, ImGuiSelectableFlags_SpanAllColumns))
        inspector.chosen = inspector.chosen == row ? -1 : row;
    controls.place(("shifts.row" + std::to_string(row)).c_str(),
                   "A base path that is shifted from its own pixel to another. Click to list the vertices of the "
                   "offset path.");
    if (ImGui::IsItemHovered())
        inspector.marked = row;
    ImGui::PopID();
    cell(short_text(s.to));
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float font = ImGui::GetFontSize(), radius = font * 0.28f;
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + radius, at.y + font * 0.55f}, radius, outcome_colour(s),
                                                12);
    ImGui::SetCursorScreenPos({at.x + font * 0.8f, at.y});
    ImGui::TextUnformatted(outcome_text(s).c_str());
    cell(s.jacobian > 0 ? short_text(s.jacobian) : "");
    cell(s.ratio > 0 ? short_text(s.ratio) : "");
    cell(s.weight > 0 ? short_text(s.weight) : "");
    cell(short_text(s.value));
}

} // namespace

std::string short_text(float value) {
    char buffer[24];
    std::snprintf(buffer, sizeof buffer, "%.4g", static_cast<double>(value));
    return buffer;
}

std::string short_text(const Rgb& value) {
    return short_text(luminance(value));
}

std::string short_text(glm::ivec2 pixel) {
    return std::to_string(pixel.x) + ", " + std::to_string(pixel.y);
}

namespace {

/// Returns the base path of a pixel.
const std::vector<InspectedVertex>& base_path(const Inspection& inspection, glm::ivec2 pixel) {
    for (const InspectedSet& set : inspection.sets)
        if (const int k = set.index_of(pixel); k >= 0 && pixel != inspection.pixel)
            return set.base(k).path;
    return inspection.path;
}

} // namespace

void draw_vertex_table(const Inspector& inspector, float width, Controls& controls) {
    const InspectedShift* shift = chosen_shift(inspector);
    const Inspection& inspection = *inspector.inspection;
    const glm::ivec2 pixel = shift ? shift->from : inspection.pixel;
    std::string title = "Base path of (" + short_text(pixel) + ")";
    if (shift && shift->steps.empty())
        title += ", to (" + short_text(shift->to) + "): " + outcome_text(*shift);
    if (shift && shift->steps.empty())
        shift = nullptr; // there is no offset path to list
    if (shift)
        title = "Path of (" + short_text(shift->from) + ") shifted to (" + short_text(shift->to) +
                "): " + (shift->ending.empty() ? outcome_text(*shift) : std::string(shift->ending));
    ImGui::BeginChild("vertices.part", {width, 0});
    ImGui::TextDisabled("%s", title.c_str());
    controls.place("vertices.title",
                   "Lists the brightest of the path's light paths. Click a row of the shifts to list "
                   "its offset path; click it again for the base path.");
    if (begin_table("vertices", vertex_columns, 0, controls)) {
        const std::vector<InspectedVertex>& path = base_path(inspection, pixel);
        for (std::size_t i = 0; !shift && i < path.size(); ++i)
            draw_vertex(path[i], i);
        for (std::size_t i = 0; shift && i < shift->steps.size(); ++i)
            draw_step(shift->steps[i], shift->from == shift->to);
        ImGui::EndTable();
    }
    ImGui::EndChild();
}

void draw_shift_table(Inspector& inspector, float width, Controls& controls) {
    inspector.marked = ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows) ? inspector.marked : -1;
    if (!begin_table("shifts", shift_columns, width, controls))
        return;
    const std::vector<const InspectedShift*> shifts = shown_shifts(inspector);
    for (std::size_t i = 0; i < shifts.size(); ++i)
        draw_shift_row(*shifts[i], static_cast<int>(i), inspector, controls);
    ImGui::EndTable();
}

} // namespace tessera
