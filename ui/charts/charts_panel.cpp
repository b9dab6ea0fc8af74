#include "recon/enumeration.h"
#include "ui/charts/charts.h"
#include "ui/gl/controls.h"
#include "ui/gl/theme.h"
#include "ui/state/words.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <glm/common.hpp>

namespace tessera {

namespace {

// Heights, in sizes of the font.
constexpr float plot_height = 14, small_plot_height = 11, histogram_height = 7;

const std::vector<ChoiceItem> kinds = choice_items(words::charts);

constexpr const char* help_of(ChartKind kind) {
    switch (kind) {
    case ChartKind::error:
        return "relMSE of each pane's picture to the reference: the mean of (I - r)^2 / (r^2 + 0.001) [Bauszat "
               "2017, 4], against what it has taken; to a reference with halves (I - r1) (I - r2), in which the "
               "reference's own noise cancels. Without a reference, an estimate for each pane's samples, by what "
               "two halves of them disagree on. Both axes are logarithmic.";
    case ChartKind::efficiency:
        return "1 / (relMSE x seconds), 1/s, of each pane's picture. The line of a method without bias becomes "
               "level; the higher one needs less time for the same error. Both axes are logarithmic.";
    case ChartKind::shifts:
        return "The share of all shifts so far by how they ended, per cent. Both axes are logarithmic.";
    }
    return "";
}

/// Takes room of a height as an item, and says where it is.
ScreenRect take_room(float height) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
    ImGui::Dummy({width, height});
    return {{at.x, at.y}, {at.x + width, at.y + height}};
}

void coloured(ImU32 colour, const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

/// "   slope -1.02 ± 0.03", or nothing while it is not known.
std::string slope_text(const std::optional<Slope>& slope) {
    return slope ? fmt::format("   slope {:.2f} ± {:.2f}", slope->value, slope->error) : "";
}

/// "0.0123 ± 0.0004   slope -1.02 ± 0.03": the newest point of a line. An estimate has a ~.
std::string figures_text(const ViewerState& state, const ChartSeries& series) {
    if (series.points.empty())
        return state.companions.reference ? "no error yet" : "no estimate yet";
    const ChartPoint& newest = series.points.back();
    const bool has_error = std::isfinite(newest.error) && newest.error > 0;
    return fmt::format("{}{:.3g}{}{}{}", state.companions.reference ? "" : "~", newest.y,
                       has_error ? fmt::format(" ± {:.1g}", newest.error) : "",
                       state.layout.chart_kind == ChartKind::efficiency ? " /s" : "",
                       slope_text(slope_of_last_decade(series)));
}

/// Draws for each line of the plot the newest error or efficiency and the slope, and what all of them lack.
void draw_figures(Controls& controls, const ViewerState& state, const ChartPlot& plot,
                  const std::vector<ImU32>& colours) {
    float widest = 0, widest_figures = 0;
    std::vector<std::string> figures;
    for (const ChartSeries& series : plot.series) {
        figures.push_back(figures_text(state, series));
        widest = std::max(widest, ImGui::CalcTextSize(series.label.c_str()).x);
        widest_figures = std::max(widest_figures, ImGui::CalcTextSize(figures.back().c_str()).x);
    }
    const float font = ImGui::GetFontSize(), beside = ImGui::GetStyle().WindowPadding.x + widest + font;
    const bool fits = widest + font + widest_figures <= ImGui::GetContentRegionAvail().x;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        coloured(colours[i], plot.series[i].label.c_str());
        if (fits)
            ImGui::SameLine(beside);
        else
            ImGui::SetCursorPosX(ImGui::GetCursorPosX() + font);
        ImGui::TextUnformatted(figures[i].c_str());
        controls.place(
            ("charts.figures" + std::to_string(i)).c_str(),
            "The newest value with its standard error where that is known, and then the slope of the line over "
            "its last decade, with at most its own: -1 for an error that falls as noise does, 0 for its "
            "efficiency. "
            "~: estimated without a reference.");
    }
    const std::string caveat = chart_caveat(state);
    if (caveat.empty())
        return;
    ImGui::PushStyleColor(ImGuiCol_Text, colours::dim_text);
    ImGui::TextWrapped("%s", caveat.c_str());
    ImGui::PopStyleColor();
    controls.place(
        "charts.caveat",
        state.companions.reference
            ? "References made here, or by tessera reference, have two halves that are independent of each "
              "other: errors against both are free of their noise."
            : "Without a reference: what two halves of the samples disagree on says how far raw samples are from "
              "the truth. Reconstructions err less, and in other ways, which only a "
              "reference shows. Edges of lamps that the camera sees are not in it. There is no estimate "
              "until it is about known how bright the picture is.");
}

/// Draws a line for each outcome, with the newest share in every pane that has a plot.
void draw_shares(Controls& controls, const ViewerState& state, const Chart& chart,
                 const std::vector<ImU32>& colours) {
    const float font = ImGui::GetFontSize();
    const auto column = [&](std::size_t plot) { return font * (7.5f + 4 * static_cast<float>(plot)); };
    const std::vector<std::size_t> panes = shifting_panes(state);
    for (std::size_t plot = 0; plot < panes.size(); ++plot) {
        ImGui::SetCursorPosX(column(plot));
        ImGui::TextDisabled("%s", pane_name(state, panes[plot]).c_str());
        if (plot + 1 < panes.size())
            ImGui::SameLine();
    }
    for (std::size_t i = 0; i < colours.size(); ++i) {
        coloured(colours[i], chart.plots.front().series[i].label.c_str());
        for (std::size_t plot = 0; plot < chart.plots.size(); ++plot) {
            const auto& points = chart.plots[plot].series[i].points;
            ImGui::SameLine(column(plot));
            ImGui::Text("%.1f %%", points.empty() ? 0.0 : points.back().y);
        }
    }
    controls.place("charts.shares", "The newest share of each outcome, a column for each pane.");
}

/// Draws the chart that is chosen, `height` of all its plots together, and what it says in numbers.
void draw_chart(Controls& controls, const ViewerState& state, float height) {
    const Chart chart = viewer_chart(state);
    const std::vector<ImU32> colours = line_colours(state);
    if (chart.plots.empty()) {
        ImGui::TextDisabled("No pane has shifted a path");
        return;
    }
    const float each = height / static_cast<float>(chart.plots.size());
    for (std::size_t i = 0; i < chart.plots.size(); ++i) {
        draw_plot(take_room(each), chart.plots[i], colours);
        controls.place(("charts." + kinds[static_cast<std::size_t>(state.layout.chart_kind)].id +
                        (i > 0 ? std::to_string(i) : ""))
                           .c_str(),
                       help_of(state.layout.chart_kind));
    }
    if (state.layout.chart_kind == ChartKind::shifts)
        draw_shares(controls, state, chart, colours);
    else
        draw_figures(controls, state, chart.plots.front(), colours);
}

float chart_height(const ViewerState& state) {
    const float font = ImGui::GetFontSize();
    if (state.layout.chart_kind != ChartKind::shifts)
        return font * plot_height;
    const std::size_t plots = shifting_panes(state).size();
    return font * (plots > 1 ? small_plot_height * static_cast<float>(plots) : plot_height);
}

/// Draws the bins on a square root scale; the bright line is what the exposure makes white.
void draw_bins(const ScreenRect& where, const Histogram& histogram, float exposure) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto most = static_cast<float>(
        std::max<std::size_t>(*std::max_element(histogram.bins.begin(), histogram.bins.end()), 1));
    const float step = where.size().x / Histogram::bin_count;
    for (int bin = 0; bin < Histogram::bin_count; ++bin) {
        const float share = std::sqrt(static_cast<float>(histogram.bins[bin]) / most);
        const float left = where.min.x + step * static_cast<float>(bin);
        list.AddRectFilled({left, glm::mix(where.max.y, where.min.y, share)}, {left + step, where.max.y},
                           colours::dim_text);
    }
    const float stops = static_cast<float>(Histogram::last_stop - Histogram::first_stop);
    const float white = (-exposure - Histogram::first_stop) / stops;
    if (white > 0 && white < 1) {
        const float at = glm::mix(where.min.x, where.max.x, white);
        list.AddLine({at, where.min.y}, {at, where.max.y}, colours::accent);
    }
}

void draw_histogram(Controls& controls, const ViewerState& state) {
    const ScreenRect where = take_room(ImGui::GetFontSize() * histogram_height);
    controls.place(
        "charts.histogram",
        "How many pixels of the active pane's picture have which luminance, from 2^-12 to 2^8, on a square "
        "root scale. The bright line is what the exposure makes white.");
    ImGui::GetWindowDrawList()->AddRectFilled({where.min.x, where.min.y}, {where.max.x, where.max.y},
                                              IM_COL32(128, 128, 128, 25));
    const auto& histogram = state.charts.of(state.active()).histogram;
    if (!histogram)
        return;
    draw_bins(where, *histogram, state.display.tone.exposure);
    ImGui::TextDisabled("%zu black   %zu negative   %zu not finite", histogram->black, histogram->negative,
                        histogram->not_finite);
}

/// Draws the choices of a chart, and of what it is against.
void draw_choices(Controls& controls, ViewerState& state) {
    static const std::vector<ChoiceItem> axes = choice_items(words::chart_axes);
    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    const float width = std::floor((ImGui::GetContentRegionAvail().x - spacing) * 0.5f);
    int kind = static_cast<int>(state.layout.chart_kind), axis = state.layout.charts_by_spp;
    controls.bare_choice("charts.kind", kinds[static_cast<std::size_t>(kind)].label.c_str(), kinds, kind, width,
                         "Which chart is shown.");
    ImGui::SameLine();
    controls.bare_choice("charts.axis", axes[axis].label.c_str(), axes, axis, -FLT_MIN,
                         "What it is shown against.");
    state.layout.chart_kind = static_cast<ChartKind>(kind);
    state.layout.charts_by_spp = axis == 1;
}

/// Two ways to a reference: one from a file, and one that is made here.
void draw_reference_buttons(Controls& controls, ViewerState& state) {
    if (controls.button("charts.open_reference", "Open a reference ...", "Chooses an EXR file."))
        state.layout.choosing = FilePurpose::reference;
    ImGui::SameLine();
    if (controls.button("charts.make_reference", "Make one ...", "Renders a reference of what the panes show."))
        state.reference_making.show = true;
}

void draw_chart_buttons(Controls& controls, ViewerState& state) {
    if (controls.button("charts.large", state.layout.large_charts ? "Small" : "Large",
                        state.layout.large_charts
                            ? "Draws them here again (Esc)."
                            : "Draws chart and histogram over the pictures instead of here."))
        state.layout.large_charts = !state.layout.large_charts;
    ImGui::SameLine();
    if (controls.button("charts.save", "Save",
                        "Writes the points of all panes and the histogram as CSV, the chart as SVG, and a picture "
                        "of it as PNG, to the folder where was saved last."))
        state.save(SaveKind::charts);
}

void draw_contents(Controls& controls, ViewerState& state) {
    heading("Charts");
    draw_choices(controls, state);
    if (state.layout.chart_kind != ChartKind::shifts && !state.companions.reference)
        draw_reference_buttons(controls, state);
    if (!state.layout.large_charts)
        draw_chart(controls, state, chart_height(state));
    draw_chart_buttons(controls, state);
    if (state.layout.large_charts)
        return;
    heading("Histogram");
    draw_histogram(controls, state);
}

} // namespace

void draw_charts_panel(const ScreenRect& where, Controls& controls, ViewerState& state) {
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    if (ImGui::Begin("Charts", nullptr, side_panel_flags)) {
        ImGui::GetWindowDrawList()->AddLine({where.min.x, where.min.y}, {where.max.x, where.min.y}, colours::line);
        draw_contents(controls, state);
    }
    ImGui::End();
}

void draw_large_charts(const ScreenRect& where, Controls& controls, const ViewerState& state) {
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    if (ImGui::Begin("Large charts", nullptr, overlay_flags)) {
        const float font = ImGui::GetFontSize(), line = ImGui::GetTextLineHeightWithSpacing();
        const auto lines = static_cast<float>(line_colours(state).size() + 2); // one above, and the caveat below
        ImGui::TextDisabled("%s", viewer_chart(state).title.c_str());
        const float rest = (lines + 1) * line + font * histogram_height + 2 * ImGui::GetStyle().WindowPadding.y;
        draw_chart(controls, state, std::max(ImGui::GetContentRegionAvail().y - rest, font * plot_height));
        draw_histogram(controls, state);
    }
    ImGui::End();
    controls.place_rect("charts.picture", where.min, where.max);
}

} // namespace tessera
