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
    {"vertex",
     "x1 is what the camera sees through the pixel; y1, y2, ... are those of a shifted path, and where that "
     "joins the base path, x again."},
    {"BSDF", "What the surface is, as in scene files."},
    {"pdf_w",
     "Density of the way on, per steradian; after a perfectly smooth scatter (delta) a probability. Where a "
     "shifted path ends at a lamp: of emitter and BSDF sampling together."},
    {"Jacobian",
     "Of the shift at this vertex: solid angle of the way on at the offset over that at the base (no "
     "unit) [Kettunen 2015, 5.2; Bekaert 2002]. 1 after a delta scatter, beyond the join, and toward the "
     "environment; random replay all the way has 1, of the space of random numbers."},
    {"value",
     "Throughput up to here: product of f cos over pdf and survival, for a shifted path of f cos with the "
     "Jacobian over the base's pdf (no unit; luminance). Where the light path ends, with its light: "
     "radiance."},
    {"ratio", "Density of the shifted path up to here, with all Jacobians, over that of the base path (no unit)."},
    {"footprint",
     "What the path stands for there as one of the samples so far (violet): sides of a parallelogram, units of "
     "the scene, from the path's derivatives by its random numbers, no further than light changes by 70 % "
     "[Suykens 2001]. In brackets the side of a square by the scalar form, which does not look at light; of a "
     "shifted path this alone, as if its own pixel had drawn it."},
    {"position", "In the world, units of the scene."},
    {"alpha", "Roughness (no unit): 1 diffuse, 0 perfectly smooth. Above the shift threshold, vertices can be "
              "connected to."},
    {"survival", "Probability of the roulette on path length that the path went on (no unit)."},
    {"lamp",
     "Direct light at this vertex by emitter sampling, with its MIS weight: luminance of the radiance toward "
     "the vertex before."},
    {"hit", "The same by BSDF sampling: the way on meets a lamp. One that is seen in mirrors alone is none of the "
            "path's light."},
};
constexpr Column shift_columns[] = {
    {"from", "Pixel whose base path is shifted."},
    {"to", "Pixel that it is shifted to."},
    {"outcome",
     "How the shift ended. own: the pixel's own path; not tried: the path is dark, or the roulette ended "
     "it. A click lists its vertices."},
    {"Jacobian",
     "|J| of the light path that brings most, as the estimator has it: the product over its vertices, of "
     "solid angles (no unit)."},
    {"ratio", "r_m of the light path that brings most: density of the shifted path over the base's, with the "
              "Jacobian (no unit) [Bekaert 2002, Bauszat 2017]."},
    {"weight", "1/R of that light path over the probability of survival (no unit)."},
    {"value",
     "What the pixel gets of all light paths in that set, of several the mean counts: luminance of the radiance."},
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

void surface_cells(const SeenVertex& x) {
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
    return !s.is_tried ? "not tried" : s.from == s.to ? "own" : in_words(to_string(s.outcome));
}

void draw_shift_row(const InspectedShift& s, int row, Inspector& inspector, Controls& controls) {
    ImGui::TableNextColumn();
    ImGui::PushID(row);
    const bool lit = inspector.marked == row || inspector.chosen == row;
    if (ImGui::Selectable(short_text(s.from).c_str(), lit, ImGuiSelectableFlags_SpanAllColumns))
        inspector.chosen = inspector.chosen == row ? -1 : row;
    controls.place(
        ("shifts.row" + std::to_string(row)).c_str(),
        "A base path, taken from its own pixel to another one. A click lists the vertices of the offset path.");
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

/// The base path of a pixel.
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
        shift = nullptr; // there is nothing but the base path to list
    if (shift)
        title = "Path of (" + short_text(shift->from) + ") shifted to (" + short_text(shift->to) +
                "): " + (shift->ending.empty() ? outcome_text(*shift) : std::string(shift->ending));
    ImGui::BeginChild("vertices.part", {width, 0});
    ImGui::TextDisabled("%s", title.c_str());
    controls.place("vertices.title",
                   "Of all its light paths, the one that brings most is listed. A row of the shifts "
                   "chooses, and chosen again, gives way to the base path.");
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
