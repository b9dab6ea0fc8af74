#include "ui/charts/charts.h"
#include "ui/gl/theme.h"
#include "ui/panels/panels.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

namespace {

using State = FollowedJob::State;

ImU32 colour_of(State state) {
    return state == State::done ? colours::accent : state == State::claimed ? colours::warning : colours::dim_text;
}

std::string text_of(const FollowedJob& job) {
    return job.state == State::done      ? "done"
           : job.state == State::waiting ? "waiting"
           : job.worker.empty()          ? "claimed"
                                         : "claimed by " + job.worker;
}

/// Draws the fractions of jobs that are done, claimed and waiting as one bar.
void draw_bar(Controls& controls, const FollowedFolder& seen) {
    const auto all = static_cast<float>(std::max<std::size_t>(seen.jobs.size(), 1));
    const ImVec2 min = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, std::floor(ImGui::GetFontSize() * 0.5f));
    ImGui::Dummy(size);
    controls.place("jobs.bar", "Jobs that are done, claimed by a worker, and waiting.");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, {min.x + size.x, min.y + size.y}, IM_COL32(128, 128, 128, 60));
    float left = min.x;
    for (const State state : {State::done, State::claimed}) {
        const float right = left + size.x * static_cast<float>(seen.count(state)) / all;
        list.AddRectFilled({left, min.y}, {right, min.y + size.y}, colour_of(state));
        left = right;
    }
}

std::vector<ImU32> colours_of(const ChartPlot& plot) {
    std::vector<ImU32> all;
    for (const ChartSeries& series : plot.series)
        all.push_back(series.look.method ? method_colour(*series.look.method) : colours::text);
    return all;
}

/// Draws the key of the lines, which all plots share.
void draw_key(const ChartPlot& plot) {
    const float font = ImGui::GetFontSize();
    const std::vector<ImU32> all = colours_of(plot);
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        const ChartSeries& series = plot.series[i];
        const float width = ImGui::CalcTextSize(series.label.c_str()).x + 4 * font;
        if (i > 0)
            ImGui::SameLine();
        if (ImGui::GetContentRegionAvail().x < width)
            ImGui::NewLine();
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float y = at.y + ImGui::GetTextLineHeight() * 0.5f;
        const ImVec2 ends[] = {{at.x, y}, {at.x + 2 * font, y}};
        draw_dashed(ends, dashes_of(series.look), all[i], std::max(font / 8, 1.0f));
        if (!series.is_level)
            draw_marker({at.x + font, y}, series.look.marker, font * 0.22f, all[i]);
        ImGui::Dummy({2 * font, ImGui::GetTextLineHeight()});
        ImGui::SameLine();
        ImGui::TextUnformatted(series.label.c_str());
    }
}

void draw_row(const FollowedJob& job) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(job.what.c_str());
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, colour_of(job.state));
    ImGui::TextUnformatted(text_of(job).c_str());
    ImGui::PopStyleColor();
}

void draw_trouble(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colours::error);
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::PopStyleColor();
}

/// Draws the first few texts. A damaged folder can have thousands.
void draw_trouble(const std::vector<std::string>& texts) {
    constexpr std::size_t shown_texts = 3;
    for (std::size_t i = 0; i < std::min(texts.size(), shown_texts); ++i)
        draw_trouble(texts[i]);
    if (texts.size() > shown_texts)
        draw_trouble(fmt::format("and {} more files that cannot be read", texts.size() - shown_texts));
}

/// Draws the numbers of jobs to the right of the last item.
void draw_count(Controls& controls, const FollowedFolder& seen) {
    ImGui::SameLine();
    ImGui::Text("%s", fmt::format("{}: {} of {} jobs done, {} claimed, {} waiting", seen.command,
                                  seen.count(State::done), seen.jobs.size(), seen.count(State::claimed),
                                  seen.count(State::waiting))
                          .c_str());
    controls.place("jobs.count", "Numbers of jobs. Rendering a missing reference is a job, too.");
}

} // namespace

void JobsPanel::draw_charts(Controls& controls, const FollowedFolder& seen, glm::vec2 room) {
    if (seen.charts.empty())
        return ImGui::TextDisabled("There is no chart until a job is done.");
    chart_ = std::clamp(chart_, 0, static_cast<int>(seen.charts.size()) - 1);
    if (seen.charts.size() > 1) {
        std::vector<ChoiceItem> items;
        for (std::size_t i = 0; i < seen.charts.size(); ++i)
            items.push_back({std::to_string(i), seen.charts[i].title, "The chart of this scene."});
        const std::string shown = items[chart_].label;
        controls.bare_choice("jobs.chart", shown.c_str(), items, chart_, -FLT_MIN, "Scene of the chart.");
    } else {
        ImGui::TextDisabled("%s", seen.charts.front().title.c_str());
    }
    const Chart& chart = seen.charts[chart_];
    const auto plots = static_cast<float>(chart.plots.size());
    const float height = std::max(room.y - 4 * ImGui::GetTextLineHeightWithSpacing(), 8 * ImGui::GetFontSize());
    const ImVec2 min = ImGui::GetCursorScreenPos();
    for (std::size_t i = 0; i < chart.plots.size(); ++i) {
        const float left = min.x + room.x * static_cast<float>(i) / plots;
        draw_plot({{left, min.y}, {left + room.x / plots, min.y + height}}, chart.plots[i],
                  colours_of(chart.plots[i]));
    }
    ImGui::Dummy({room.x, height});
    controls.place("jobs.plots", "Results so far, as in the report of the command.");
    if (!chart.plots.empty())
        draw_key(chart.plots.front());
}

void JobsPanel::draw_list(Controls& controls, const FollowedFolder& seen) {
    controls.toggle("jobs.claimed", "Only running jobs", only_claimed_,
                    "Lists only jobs that a worker has claimed.");
    std::vector<const FollowedJob*> shown;
    for (const FollowedJob& job : seen.jobs)
        if (!only_claimed_ || job.state == State::claimed)
            shown.push_back(&job);
    if (!ImGui::BeginTable("jobs", 2, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg))
        return;
    ImGuiListClipper clipper; // there can be a hundred thousand jobs
    clipper.Begin(static_cast<int>(shown.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            draw_row(*shown[i]);
    ImGui::EndTable();
}

void JobsPanel::draw(const ScreenRect& where, Controls& controls, ViewerState& state,
                     const FolderFollower::View& view) {
    if (folder_ != view.folder)
        chart_ = 0;
    folder_ = view.folder;
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    if (ImGui::Begin("Followed folder", nullptr, overlay_flags)) {
        heading(view.folder.empty() ? "No folder is followed" : view.folder.string().c_str());
        if (controls.button("jobs.choose", "Follow another ...",
                            "Chooses the output folder of tessera bench, sweep or stability."))
            state.layout.choosing = FilePurpose::jobs;
        ImGui::SameLine();
        if (controls.button("jobs.close", "Close",
                            "Closes this page (Esc). The viewer continues to follow the folder."))
            state.layout.show_jobs = false;
        if (view.seen)
            draw_count(controls, *view.seen);
        if (!view.error.empty()) {
            draw_trouble(view.error);
            controls.place("jobs.error",
                           "Error while reading the folder. The viewer tries again regularly, and shows "
                           "the last state that it could read.");
        }
        if (view.seen) {
            const FollowedFolder& seen = *view.seen;
            draw_bar(controls, seen);
            draw_trouble(seen.trouble);
            const ImVec2 room = ImGui::GetContentRegionAvail();
            draw_charts(controls, seen, {room.x, room.y * 0.62f});
            draw_list(controls, seen);
        }
    }
    ImGui::End();
    controls.place_rect("jobs", where.min, where.max);
}

} // namespace tessera
