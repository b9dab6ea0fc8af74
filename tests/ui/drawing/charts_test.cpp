// Charts of errors and of shift outcomes.

#include "tests/ui/drawing/charts_fixture.h"
#include "ui/charts/charts.h"
#include "ui/panes/pane_parts.h"
#include "ui/state/companions.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

TEST(PassHistory, KeepsTheNewestPointAndThinsOlderOnes) {
    PassHistory<ErrorPoint> history;
    for (int spp = 1; spp <= 1000; ++spp)
        history.add({spp, 0.01 * spp, 2.0 / spp, 0, 0});
    EXPECT_EQ(history.points().back().spp, 1000);
    EXPECT_LT(history.points().size(), 200u);
    EXPECT_GT(history.points().size(), 50u);
    EXPECT_EQ(history.points().front().spp, 1);
    history.add({1000, 10, 7, 0, 0}); // a new reconstruction of the same samples
    EXPECT_EQ(history.points().back().error, 7);
}

TEST(ViewerCharts, SlopeIsOfTheLastDecade) {
    ChartSeries series;
    EXPECT_FALSE(slope_of_last_decade(series));
    for (int n = 1; n <= 1000; n *= 2)
        series.points.push_back({static_cast<double>(n), n < 50 ? 5 : 3.0 / n, n < 50 ? 5 : 0.3 / n});
    ASSERT_TRUE(slope_of_last_decade(series));
    EXPECT_NEAR(slope_of_last_decade(series)->value, -1, 1e-9);
    EXPECT_GT(slope_of_last_decade(series)->error, 0.1); // errors of 10 % with opposite signs at both ends
    EXPECT_LT(slope_of_last_decade(series)->error, 0.25);
}

TEST(ViewerCharts, ASlopeNeedsStandardErrorsAndARange) {
    ChartSeries series;
    for (int n = 1; n <= 64; n *= 2)
        series.points.push_back({static_cast<double>(n), 3.0 / n, NAN});
    EXPECT_FALSE(slope_of_last_decade(series)); // a reference without halves
    for (ChartPoint& p : series.points)
        p.error = 0.01 * p.y;
    EXPECT_TRUE(slope_of_last_decade(series));
    series.points.resize(2); // from one sample to two
    EXPECT_FALSE(slope_of_last_decade(series));
}

// Before a reference exists, curves show estimates.
TEST_F(Charts, WithoutAReferenceTheErrorOfRawSamplesIsEstimated) {
    for (int spp : {4, 8, 16}) {
        state().rendering.pace.spp_limit = spp;
        wait_for_errors(0, spp);
        wait_for_errors(1, spp);
    }
    const std::vector<ErrorPoint> before = errors(1);
    ASSERT_GE(before.size(), 3u); // from the first passes on, even with the panel closed
    EXPECT_LE(before.front().spp, 4);
    EXPECT_LT(before.back().error, 0.5 * before.front().error);
    EXPECT_GT(before.back().standard_error, 0);
    EXPECT_LT(before.back().error, errors(0).back().error); // path reuse lowers the error
    char error[48];
    std::snprintf(error, sizeof error, "   estimated relMSE %.3g", before.back().error);
    EXPECT_NE(status_text(state(), 1).find(error), std::string::npos) << status_text(state(), 1);
    type(Key::h);
    frames(2);
    save("charts-estimated.png");
    EXPECT_TRUE(has("charts.figures1"));
    EXPECT_NE(chart_caveat(state()).find("own variance"), std::string::npos);
    const Chart chart = viewer_chart(state());
    ASSERT_EQ(chart.plots.at(0).series.size(), 2u);
    EXPECT_EQ(chart.plots[0].y_label, "relMSE, estimated");
    EXPECT_EQ(chart.plots[0].series[1].label, "2  G-PR, samples");
    EXPECT_EQ(chart.plots[0].series[1].points.size(), before.size());
    EXPECT_NE(chart_csv(state()).find("2,gpr,none,,16,"), std::string::npos) << chart_csv(state());

    // Another reconstruction has the same raw samples.
    state().panes[1].settings.reconstruction.norm = Norm::l1;
    wait_until([&] { return viewer.settled(16); });
    frames(5);
    EXPECT_EQ(state().charts[1].curves.size(), 1u);

    // Errors replace estimates.
    set_reference(Rgb(0.3f));
    EXPECT_TRUE(viewer_chart(state()).plots.at(0).series[1].points.empty());
    wait_until([&] { return state().charts[1].reference != nullptr; });
    EXPECT_EQ(viewer_chart(state()).plots.at(0).y_label, "relMSE");
    EXPECT_EQ(chart_caveat(state()).find("own variance"), std::string::npos);
    EXPECT_NE(status_text(state(), 1).find("   relMSE "), std::string::npos) << status_text(state(), 1);
}

TEST_F(Charts, EachPointKeepsItsSettings) {
    set_reference(Rgb(0.3f));
    for (int spp : {4, 8}) {
        state().rendering.pace.spp_limit = spp;
        wait_for_errors(1, spp);
    }
    char error[32];
    std::snprintf(error, sizeof error, "   relMSE %.3g", errors(1).back().error);
    EXPECT_NE(status_text(state(), 1).find(error), std::string::npos) << status_text(state(), 1);
    const std::size_t weighted = errors(1).size();
    EXPECT_GE(weighted, 2u);
    state().panes[1].settings.reconstruction = {Norm::l1, 0.3f};
    wait_until([&] { return state().charts[1].curves.size() == 2; });
    state().rendering.pace.spp_limit = 16;
    wait_for_errors(1, 16);
    EXPECT_EQ(state().charts[1].curves[0].points().size(), weighted);
    EXPECT_EQ(state().charts[1].curves[0].reconstruction.norm, Norm::guided);
    EXPECT_EQ(state().charts[1].curves[1].reconstruction.norm, Norm::l1);
    EXPECT_EQ(state().charts[0].curves.size(), 1u); // PT shows raw samples
    const std::string csv = chart_csv(state());
    for (const char* line : {"1,pt,none,,16,", "2,gpr,guided,0.2,8,", "2,gpr,l1,0.3,8,", "2,gpr,l1,0.3,16,"})
        EXPECT_NE(csv.find(line), std::string::npos) << line << "\n" << csv;
    EXPECT_EQ(csv.find("guided,0.2,16"), std::string::npos) << csv;
    const Chart chart = viewer_chart(state());
    ASSERT_EQ(chart.plots.at(0).series.size(), 3u);
    EXPECT_EQ(chart.plots[0].series[1].label, "2  G-PR, guided, alpha 0.2");
    EXPECT_EQ(chart.plots[0].series[2].label, "2  G-PR, L1, alpha 0.3");
    EXPECT_NE(chart.plots[0].series[1].look, chart.plots[0].series[2].look);
    EXPECT_EQ(line_colours(state()).size(), 3u);
    type(Key::h);
    frames(2);
    save("charts-two-lines.png");

    // Values that a dragged slider passes leave no lines. A line continues when its settings return.
    for (float alpha : {0.31f, 0.32f, 0.33f}) {
        state().panes[1].settings.reconstruction.alpha = alpha;
        wait_until([&] { return state().charts[1].curves.back().reconstruction.alpha == alpha; });
    }
    EXPECT_EQ(state().charts[1].curves.size(), 3u);
    state().panes[1].settings.reconstruction = {};
    wait_until([&] { return state().charts[1].curves.back().reconstruction.norm == Norm::guided; });
    EXPECT_EQ(errors(1).size(), weighted + 1);

    // Until pictures of another method are measured, points and colour are those of the previous method.
    const ImU32 colour = line_colours(state()).back();
    state().panes[1].settings.render.method = Method::pr;
    EXPECT_EQ(line_colours(state()).back(), colour);
    EXPECT_EQ(chart_csv(state()).find("2,pr,"), std::string::npos);
    EXPECT_EQ(viewer_chart(state()).plots.at(0).series.back().label.rfind("2  G-PR, guided", 0), 0u);
}

TEST_F(Charts, APaneKeepsItsLinesWhenTheLayoutChanges) {
    set_reference(Rgb(0.3f));
    for (int spp : {4, 8}) {
        state().rendering.pace.spp_limit = spp;
        wait_for_errors(1, spp);
    }
    state().active_pane = 1;
    const auto before = errors(1);
    ASSERT_GE(before.size(), 2u);
    state().set_pane_count(1); // the second becomes the first
    frames(3);
    EXPECT_EQ(errors(0).size(), before.size());
    ASSERT_EQ(viewer_chart(state()).plots.at(0).series.size(), 1u);
    EXPECT_EQ(viewer_chart(state()).plots[0].series[0].label, "1  G-PR");
    EXPECT_EQ(viewer_chart(state()).plots[0].series[0].points.size(), before.size());
    EXPECT_NE(chart_csv(state()).find("1,gpr,guided"), std::string::npos);
    state().set_pane_count(2);
    wait_for_errors(1, 8);
    EXPECT_EQ(errors(0).size(), before.size());
}

/// Returns noise with mean zero that depends on the seed only.
RgbImage noisy(Rgb value, float noise, unsigned seed) {
    RgbImage image(48, 36, value);
    for (Rgb& pixel : image) {
        seed = seed * 1664525u + 1013904223u;
        pixel += Rgb(noise * (static_cast<float>(seed >> 8) / static_cast<float>(1 << 23) - 1));
    }
    return image;
}

TEST_F(Charts, AReferenceWithHalvesAddsNoErrorOfItsOwn) {
    const Rgb truth(0.5f);
    const RgbImage a = noisy(truth, 0.1f, 1), b = noisy(truth, 0.1f, 7);
    RgbImage mean = a;
    for (std::size_t i = 0; i < mean.size(); ++i)
        mean.data()[i] = 0.5f * (a.data()[i] + b.data()[i]);
    const auto plain = make_reference("plain", mean, {}), halves = make_reference("halves", mean, {a, b});
    const RgbImage picture(48, 36, truth);
    const PictureError with_floor = error_to(*plain, picture).value(), error = error_to(*halves, picture).value();
    EXPECT_GT(with_floor.relative_mse, 0.004); // 0.1^2 / 3 / 2 / 0.25
    EXPECT_TRUE(std::isnan(with_floor.standard_error));
    EXPECT_LT(std::abs(error.relative_mse), 4 * error.standard_error);
    EXPECT_LT(error.standard_error, 0.001);
    EXPECT_NE(reference_caveat(*plain).find("no halves"), std::string::npos);
    EXPECT_EQ(reference_caveat(*halves), "");
    EXPECT_TRUE(make_reference("other size", mean, {RgbImage(4, 4), RgbImage(4, 4)})->halves[0].empty());
}

TEST_F(Charts, StandardErrorsAreDrawnAsBars) {
    const auto drawn = [&](double error) {
        const ChartPlot plot{"x",
                             "y",
                             ChartAxis::Scale::log,
                             ChartAxis::Scale::log,
                             {},
                             {{"ends", {{1, 1}, {10, 100}}}, {"line", {{2, 5}, {3, 10, error}, {5, 10}}}}};
        const ImU32 colours[] = {IM_COL32(200, 200, 200, 255), IM_COL32(255, 160, 0, 255)};
        gui.begin_frame(glm::vec2(context.size()), 1, 0.01f);
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({600, 400});
        ImGui::Begin("plot", nullptr, ImGuiWindowFlags_NoDecoration);
        draw_plot({{0, 0}, {600, 400}}, plot, colours);
        ImGui::End();
        gui.end_frame();
        return screen();
    };
    drawn(0);
    const ScreenPixels without = drawn(0), with = drawn(5); // the bars do not extend the axes
    save("chart-bars.png");
    int column = -1, rows = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 600; ++x)
            if (std::abs(with.at(x, y)[0] - without.at(x, y)[0]) > 20) {
                EXPECT_TRUE(column < 0 || std::abs(x - column) <= 1) << x;
                column = column < 0 ? x : column;
                ++rows;
            }
    EXPECT_GT(rows, 30);
    EXPECT_EQ(drawn(NAN).rgb, without.rgb);
}

TEST_F(Charts, NonFinitePixelsAreSkippedAndCounted) {
    for (const bool halves : {false, true}) {
        RgbImage image(48, 36, Rgb(0.5f));
        image(3, 4) = Rgb(NAN);
        image(5, 4) = Rgb(INFINITY);
        const auto pair = halves ? std::array{image, image} : std::array<RgbImage, 2>{};
        const auto reference = make_reference("broken", image, pair);
        EXPECT_EQ(reference->not_finite, 2u);
        RgbImage picture(48, 36, Rgb(0.7f));
        picture(9, 9) = Rgb(NAN);
        const PictureError error = error_to(*reference, picture).value();
        EXPECT_EQ(error.not_finite, 3u);
        EXPECT_NEAR(error.relative_mse, 0.04 / 0.251, 1e-6);
        EXPECT_FALSE(error_to(*reference, RgbImage(48, 36, Rgb(NAN))).has_value());
    }
    RgbImage image(48, 36, Rgb(0.5f));
    image(3, 4) = Rgb(NAN);
    state().companions.reference = make_reference("broken", image, {});
    wait_until([&] { return !errors(1).empty(); });
    EXPECT_EQ(errors(1).back().not_finite, 1u);
    type(Key::h);
    frames(2);
    EXPECT_TRUE(has("charts.caveat"));
    EXPECT_NE(chart_caveat(state()).find("1 of its pixels"), std::string::npos) << chart_caveat(state());
    save("charts-caveat.png");
}

TEST_F(Charts, ErrorsAreMeasuredPassByPass) {
    set_reference(Rgb(0.3f));
    for (int spp : {4, 8, 16}) {
        state().rendering.pace.spp_limit = spp;
        wait_until([&] { return viewer.settled(spp); });
        wait_until([&] {
            const auto a = errors(0), b = errors(1);
            return !a.empty() && a.back().spp == spp && !b.empty() && b.back().spp == spp;
        });
    }
    type(Key::h);
    EXPECT_TRUE(state().layout.show_charts);
    wait_until([&] { return state().charts[1].histogram != nullptr; });
    frames(2);
    save("charts.png");
    EXPECT_TRUE(has("charts.error"));
    EXPECT_TRUE(has("charts.histogram"));
    const std::string csv = chart_csv(state());
    EXPECT_NE(csv.find("1,pt,none,,16,"), std::string::npos) << csv;
    EXPECT_NE(csv.find("2,gpr,guided,0.2,16,"), std::string::npos) << csv;
    choose("charts.axis", "spp");
    EXPECT_TRUE(state().layout.charts_by_spp);

    // Another reference or request starts new curves.
    set_reference(Rgb(0.5f));
    wait_until([&] { return state().charts[0].reference == state().companions.reference; });
    EXPECT_EQ(errors(0).size(), 1u);
    state().panes[0].settings.render.max_depth = 2;
    wait_until([&] { return state().charts[0].generation == pane(0).generation; });
    EXPECT_LE(errors(0).size(), 3u);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(Charts, ShiftsEqualTheStatistics) {
    type(Key::h);
    choose("charts.kind", "shifts");
    EXPECT_EQ(state().layout.chart_kind, ChartKind::shifts);
    for (int spp : {4, 8, 16}) {
        state().rendering.pace.spp_limit = spp;
        wait_until([&] { return viewer.settled(spp); });
    }
    frames(2);
    save("charts-shifts.png");
    EXPECT_TRUE(state().charts[0].shifts.points().empty()); // PT has no shifts
    const auto& points = state().charts[1].shifts.points();
    ASSERT_GE(points.size(), 3u);
    EXPECT_EQ(points.back().spp, 16);
    const Counters& counters = pane(1).snapshot->counters;
    for (std::size_t i = 0; i < points.back().shares.size(); ++i)
        EXPECT_NEAR(points.back().shares[i],
                    static_cast<double>(counters.shifts[i]) / static_cast<double>(counters.shift_attempts()),
                    1e-12);
    const Chart chart = viewer_chart(state());
    ASSERT_EQ(chart.plots.size(), 1u);
    double sum = 0;
    for (const ChartSeries& series : chart.plots[0].series)
        sum += series.points.back().y;
    EXPECT_NEAR(sum, 100, 1e-9);
    EXPECT_EQ(line_colours(state()).size(), chart.plots[0].series.size());
    EXPECT_TRUE(has("charts.shifts"));

    state().panes[1].settings.render.tile = 3; // another request starts a new curve
    const std::uint64_t before = pane(1).generation;
    frames(2);
    EXPECT_NE(pane(1).generation, before);
    wait_until([&] { return state().charts[1].shift_generation == pane(1).generation; });
    wait_until([&] { return viewer.settled(16); });
    frames(1);
    EXPECT_EQ(state().charts[1].shifts.points().back().spp, 16);
    EXPECT_EQ(state().charts[1].shifts.points().back().seconds, pane(1).snapshot->seconds);
    state().set_pane_count(1);
    frames(2);
    EXPECT_EQ(state().charts.of(pane(0)).shifts.points().back().spp, 16); // the active pane stays
    EXPECT_TRUE(state().charts[0].shifts.points().empty());
}

} // namespace
} // namespace tessera::test
