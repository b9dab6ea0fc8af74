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

// Heights in font sizes.
constexpr float plot_height = 14, small_plot_height = 11, histogram_height = 7;

const std::vector<ChoiceItem> kinds = choice_items(words::charts);

constexpr const char* help_of(ChartKind kind) {
    switch (kind) {
    case ChartKind::error:
        return "relMSE of each pane's picture against the reference: the mean of (I - r)^2 / (r^2 + 0.001) "
               "[Bauszat 2017, 4]. If the reference has two halves, the numerator is (I - r1) (I - r2), in which "
               "the reference's own noise cancels. Without a reference, the error of each pane's raw samples is "
               "estimated from the disagreement of their two halves. Both axes are logarithmic.";
    case ChartKind::efficiency:
        return "1 / (relMSE x seconds), 1/s, of each pane's picture. The line of an unbiased method becomes "
               "horizontal. A higher line needs less time for the same error. Both axes are logarithmic.";
    case ChartKind::shifts:
        return "Percentage of all shifts so far by their outcome. Both axes are logarithmic.";
    }
    return "";
}

/// Adds an empty item of this height, as wide as the panel, and returns its rectangle.
ScreenRect take_room(float height) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
    ImGui::Dummy({width, height});
    return {{at.x, at.y}, {at.x + width, at.y + height}};
}

void text_in_colour(ImU32 colour, const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

/// Returns "   slope -1.02 ± 0.03", or an empty text while the slope is unknown.
std::string slope_text(const std::optional<Slope>& slope) {
    return slope ? fmt::format("   slope {:.2f} ± {:.2f}", slope->value, slope->error) : "";
}

/// Returns "0.0123 ± 0.0004   slope -1.02 ± 0.03" for the newest point of a line. An estimate begins with ~.
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

/// Draws the newest error or efficiency and the slope of each line, and the caveat.
void draw_figures(Controls& controls, const ViewerState& state, const ChartPlot& plot,
                  const std::vector<ImU32>& colours) {
    float widest = 0, widest_figures = 0;
    std::vector<std::string> figures;
    for (const ChartSeries& series : plot.series) {
        figures.push_back(figures_text(state, series));
        widest = std::max(widest, ImGui::CalcTextSize(series.label.c_str()).x);
        widest_figures = std::max(widest_figures, ImGui::CalcTextSize(figures.back().c_str()).x);
    }
    const float font = ImGui::GetFontSize(), figures_x = ImGui::GetStyle().WindowPadding.x + widest + font;
    const bool fits = widest + font + widest_figures <= ImGui::GetContentRegionAvail().x;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        text_in_colour(colours[i], plot.series[i].label.c_str());
        if (fits)
            ImGui::SameLine(figures_x);
        else
            ImGui::SetCursorPosX(ImGui::GetCursorPosX() + font);
        ImGui::TextUnformatted(figures[i].c_str());
        controls.place(
            ("charts.figures" + std::to_string(i)).c_str(),
            "The newest value with its standard error, if known; then the slope of the line over its last decade, "
            "with an upper bound of its standard error. Without bias, the slope tends to -1 for errors and to 0 "
            "for efficiencies. ~: estimated without a reference.");
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
            ? "References made here, or by tessera reference, have two independent halves. Errors against both "
              "halves do not contain the reference's own noise."
            : "Without a reference, the error of the raw samples is estimated from the disagreement of their two "
              "halves. The error and the bias of a reconstruction need a reference. The estimate does not contain "
              "noise at the edges of visible lamps. It begins when the picture's brightness is roughly known.");
}

/// Draws a row of newest percentages for each outcome, with a column for each plot.
void draw_shares(Controls& controls, const ViewerState& state, const Chart& chart,
                 const std::vector<ImU32>& colours) {
    const float font = ImGui::GetFontSize();
    const auto column = [&](std::size_t plot) { return font * (7.5f + 4 * static_cast<float>(plot)); };
    const std::vector<std::size_t> panes = panes_with_shifts(state);
    for (std::size_t plot = 0; plot < panes.size(); ++plot) {
        ImGui::SetCursorPosX(column(plot));
        ImGui::TextDisabled("%s", pane_name(state, panes[plot]).c_str());
        if (plot + 1 < panes.size())
            ImGui::SameLine();
    }
    for (std::size_t i = 0; i < colours.size(); ++i) {
        text_in_colour(colours[i], chart.plots.front().series[i].label.c_str());
        for (std::size_t plot = 0; plot < chart.plots.size(); ++plot) {
            const auto& points = chart.plots[plot].series[i].points;
            ImGui::SameLine(column(plot));
            ImGui::Text("%.1f %%", points.empty() ? 0.0 : points.back().y);
        }
    }
    controls.place("charts.shares", "The newest percentage of each outcome, one column per pane.");
}

/// Draws the chosen chart, and its figures below it. `height` is the total height of its plots.
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
    const std::size_t plots = panes_with_shifts(state).size();
    return font * (plots > 1 ? small_plot_height * static_cast<float>(plots) : plot_height);
}

/// Draws the bins on a square root scale, and a line at the luminance that the exposure maps to white.
void draw_bins(const ScreenRect& where, const Histogram& histogram, float exposure) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto most = static_cast<float>(
        std::max<std::size_t>(*std::max_element(histogram.bins.begin(), histogram.bins.end()), 1));
    const float step = where.size().x / Histogram::bin_count;
    for (int bin = 0; bin < Histogram::bin_count; ++bin) {
        const float fraction = std::sqrt(static_cast<float>(histogram.bins[bin]) / most);
        const float left = where.min.x + step * static_cast<float>(bin);
        list.AddRectFilled({left, glm::mix(where.max.y, where.min.y, fraction)}, {left + step, where.max.y},
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
        "Histogram of the luminance of the active pane's picture, from 2^-12 to 2^8, on a square root scale. "
        "The bright line marks the luminance that the exposure maps to white.");
    ImGui::GetWindowDrawList()->AddRectFilled({where.min.x, where.min.y}, {where.max.x, where.max.y},
                                              IM_COL32(128, 128, 128, 25));
    const auto& histogram = state.charts.of(state.active()).histogram;
    if (!histogram)
        return;
    draw_bins(where, *histogram, state.display.tone.exposure);
    ImGui::TextDisabled("%zu black   %zu negative   %zu not finite", histogram->black, histogram->negative,
                        histogram->not_finite);
}

/// Draws the choices of the chart and of its x axis.
void draw_choices(Controls& controls, ViewerState& state) {
    static const std::vector<ChoiceItem> axes = choice_items(words::chart_axes);
    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    const float width = std::floor((ImGui::GetContentRegionAvail().x - spacing) * 0.5f);
    int kind = static_cast<int>(state.layout.chart_kind), axis = state.layout.charts_by_spp;
    controls.bare_choice("charts.kind", kinds[static_cast<std::size_t>(kind)].label.c_str(), kinds, kind, width,
                         "Which chart is shown.");
    ImGui::SameLine();
    controls.bare_choice("charts.axis", axes[axis].label.c_str(), axes, axis, -FLT_MIN,
                         "The quantity of the x axis.");
    state.layout.chart_kind = static_cast<ChartKind>(kind);
    state.layout.charts_by_spp = axis == 1;
}

/// Draws the buttons that open a reference file or render a reference.
void draw_reference_buttons(Controls& controls, ViewerState& state) {
    if (controls.button("charts.open_reference", "Open a reference ...", "Opens an EXR file."))
        state.layout.choosing = FilePurpose::reference;
    ImGui::SameLine();
    if (controls.button("charts.make_reference", "Make one ...", "Renders a reference of what the panes show."))
        state.reference_making.show = true;
}

void draw_chart_buttons(Controls& controls, ViewerState& state) {
    if (controls.button("charts.large", state.layout.large_charts ? "Small" : "Large",
                        state.layout.large_charts ? "Moves chart and histogram back into this panel (Esc)."
                                                  : "Draws chart and histogram over the pictures."))
        state.layout.large_charts = !state.layout.large_charts;
    ImGui::SameLine();
    if (controls.button(
            "charts.save", "Save",
            "Writes the points of all panes and the histogram as CSV, and the chart as SVG and PNG, to "
            "the folder of the last save."))
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
        const auto lines =
            static_cast<float>(line_colours(state).size() + 2); // the title above, and the caveat below
        ImGui::TextDisabled("%s", viewer_chart(state).title.c_str());
        const float other_height =
            (lines + 1) * line + font * histogram_height + 2 * ImGui::GetStyle().WindowPadding.y;
        draw_chart(controls, state, std::max(ImGui::GetContentRegionAvail().y - other_height, font * plot_height));
        draw_histogram(controls, state);
    }
    ImGui::End();
    controls.place_rect("charts.picture", where.min, where.max);
}

} // namespace tessera
