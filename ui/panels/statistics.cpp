#include "ui/gl/theme.h"
#include "ui/gl/tone.h"
#include "ui/panels/panels.h"
#include "ui/state/buffer.h"
#include "ui/state/inspected.h"
#include "ui/state/words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <imgui.h>

namespace tessera {

namespace {

constexpr const char* ray_help[] = {
    "From the camera to the first surface.",
    "Feature samples (albedo, normal, depth, roughness) for the denoiser: from the camera and through mirrors. "
    "They are not part of the samples.",
    "Next segment of a base path.",
    "Occlusion between a vertex of a base path and a point on an emitter.",
    "Next segment of an offset path.",
    "Occlusion of an offset path's new edge, to a vertex of the base path or to an emitter.",
};
static_assert(std::size(ray_help) == ray_kind_count);

/// Returns part / whole; 0 if both are 0.
double ratio(std::uint64_t part, std::uint64_t whole) {
    return static_cast<double>(part) / static_cast<double>(std::max<std::uint64_t>(whole, 1));
}

std::string decimal(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", number);
    return text;
}

StatisticGroup paths(const Snapshot& snapshot) {
    const Counters& c = snapshot.counters;
    return {
        "Paths of " + std::string(paper_name(snapshot.settings.method)),
        {{"spp", "samples per pixel", std::to_string(snapshot.spp), {}, "Passes over the whole picture so far."},
         {"camera_paths",
          "camera paths",
          count_text(c.camera_paths),
          {},
          "Base paths traced in all passes, including those of the columns and rows around tiles."},
         {"path_vertices",
          "mean vertices",
          decimal(ratio(c.path_vertices, c.camera_paths)),
          {},
          "Mean number of surface vertices per base path."}}};
}

StatisticGroup rays(const Counters& c) {
    StatisticGroup group{"Rays", {{"rays", "all", count_text(c.all_rays()), {}, "Rays traced in all passes."}}};
    for (std::size_t i = 0; i < c.rays.size(); ++i) {
        const std::string_view kind = to_string(static_cast<RayKind>(i));
        if (c.rays[i] > 0)
            group.statistics.push_back({"rays." + std::string(kind), label_of_identifier(kind),
                                        count_text(c.rays[i]), ratio(c.rays[i], c.all_rays()), ray_help[i]});
    }
    return group;
}

/// Returns the fractions of base paths that were reused, as in [Bauszat 2017, Table 1].
StatisticGroup reuse(const Counters& c) {
    const std::uint64_t all = c.set_paths();
    StatisticGroup group{"Base paths",
                         {{"reused", "reused", count_text(c.reused_paths), ratio(c.reused_paths, all),
                           "Base paths that were shifted to the other pixels of their sampling set, as a "
                           "fraction of all base paths in sampling sets. Compare with the paths reused per "
                           "gradient in Table 1 of [Bauszat 2017], 14.8 to 19 %. A path counts once per set."},
                          {"skipped", "skipped", count_text(c.skipped_paths), ratio(c.skipped_paths, all),
                           "Base paths with light that Russian roulette on reuse ended. Table 1 of [Bauszat "
                           "2017] has 81.6 to 85.3 % without a category for dark paths: compare it with "
                           "skipped and dark together."},
                          {"dark", "dark", count_text(c.dark_paths), ratio(c.dark_paths, all),
                           "Base paths without light that could be reused."}}};
    return group;
}

StatisticGroup shifts(const Counters& c) {
    const std::uint64_t all = c.shift_attempts();
    StatisticGroup group{"Shifts",
                         {{"shifts",
                           "per camera path",
                           decimal(ratio(all, c.camera_paths)),
                           {},
                           "Shifts of a base path to another pixel, per camera path."}}};
    for (std::size_t i = 0; i < c.shifts.size(); ++i) {
        const auto outcome = static_cast<ShiftOutcome>(i);
        const std::string_view name = to_string(outcome);
        group.statistics.push_back({"shifts." + std::string(name), label_of_identifier(name),
                                    count_text(c.shifts[i]), ratio(c.shifts[i], all), outcome_help(outcome)});
    }
    return group;
}

} // namespace

std::string count_text(std::uint64_t count) {
    if (count < 10000)
        return std::to_string(count);
    double number = static_cast<double>(count) / 1000;
    const char* units[] = {"k", "M", "G", "T"};
    std::size_t unit = 0;
    while (number >= 999.5 && unit + 1 < std::size(units)) {
        number /= 1000;
        ++unit;
    }
    char text[32];
    std::snprintf(text, sizeof text,
                  number < 9.995   ? "%.2f %s"
                  : number < 99.95 ? "%.1f %s"
                                   : "%.0f %s",
                  number, units[unit]);
    return text;
}

std::vector<StatisticGroup> statistics(const Snapshot& snapshot) {
    const Counters& c = snapshot.counters;
    std::vector<StatisticGroup> groups{paths(snapshot), rays(c)};
    if (c.set_paths() > 0)
        groups.push_back(reuse(c));
    if (c.shift_attempts() > 0)
        groups.push_back(shifts(c));
    return groups;
}

namespace {

// Ends of a row's columns, as fractions of its width.
constexpr float value_end = 0.60f;
constexpr float share_end = 0.79f;

std::string per_cent(double share) {
    char text[16];
    std::snprintf(text, sizeof text, "%.1f %%", share * 100);
    return text;
}

void draw_right_aligned(ImDrawList& list, float right, float y, ImU32 colour, const std::string& text) {
    list.AddText({std::floor(right - ImGui::CalcTextSize(text.c_str()).x), y}, colour, text.c_str());
}

/// Draws the share as a bar in the last column.
void draw_bar(ImDrawList& list, ImVec2 min, ImVec2 max, double share, ImU32 colour) {
    const float filled = min.x + (max.x - min.x) * static_cast<float>(std::clamp(share, 0.0, 1.0));
    list.AddRectFilled(min, max, colours::line);
    list.AddRectFilled(min, {filled, max.y}, colour);
}

void draw_statistic(Controls& controls, const Statistic& figure, ImU32 bar_colour) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f), height = ImGui::GetTextLineHeight();
    ImGui::Dummy({width, height});
    controls.place(("statistics." + figure.id).c_str(), figure.help.c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText(at, colours::dim_text, figure.label.c_str());
    draw_right_aligned(list, at.x + width * value_end, at.y, colours::text, figure.value);
    if (!figure.share)
        return;
    draw_right_aligned(list, at.x + width * share_end, at.y, colours::text, per_cent(*figure.share));
    const float thickness = std::floor(height * 0.3f), top = at.y + std::floor((height - thickness) * 0.5f) + 1;
    draw_bar(list, {at.x + width * (share_end + 0.03f), top}, {at.x + width, top + thickness}, *figure.share,
             bar_colour);
}

void draw_refused(Controls& controls, const Snapshot& snapshot) {
    const std::string text = invalid_text(snapshot.counters, snapshot.settings.seed);
    if (text.empty())
        return;
    ImGui::Spacing();
    ImGui::PushStyleColor(ImGuiCol_Text, colours::warning);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    controls.place(
        "statistics.refused",
        "Pass and pixel are counted from 0. With them and the seed, the path inspector can trace the first "
        "sample again.");
}

void draw_contents(Controls& controls, const Snapshot& snapshot) {
    const ImU32 colour = method_colour(snapshot.settings.method);
    for (const StatisticGroup& group : statistics(snapshot)) {
        heading(group.title.c_str());
        for (const Statistic& figure : group.statistics)
            draw_statistic(controls, figure, colour);
    }
    draw_refused(controls, snapshot);
}

} // namespace

void draw_statistics_panel(const ScreenRect& where, Controls& controls, const ViewerState& state) {
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                        {ImGui::GetStyle().ItemSpacing.x, std::floor(ImGui::GetFontSize() * 0.15f)});
    if (ImGui::Begin("Statistics", nullptr, side_panel_flags)) {
        ImGui::GetWindowDrawList()->AddLine({where.min.x, where.min.y}, {where.max.x, where.min.y}, colours::line);
        const PaneState& pane = state.active();
        if (pane.snapshot)
            draw_contents(controls, *pane.snapshot);
        else
            ImGui::TextDisabled("no samples yet");
    }
    ImGui::End();
    ImGui::PopStyleVar();
}

} // namespace tessera
