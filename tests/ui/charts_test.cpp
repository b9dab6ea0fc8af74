// Charts: how errors fall, and histograms.

#include "tests/ui/viewer_harness.h"
#include "ui/chart_file.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

namespace tessera::test {
namespace {

TEST(ErrorHistory, KeepsTheNewestAndThinsOutTheOld) {
    ErrorHistory history;
    for (int spp = 1; spp <= 1000; ++spp)
        history.add({spp, 0.01 * spp, 2.0 / spp});
    EXPECT_EQ(history.points().back().spp, 1000);
    EXPECT_LT(history.points().size(), 200u);
    EXPECT_GT(history.points().size(), 50u);
    EXPECT_EQ(history.points().front().spp, 1);
    history.add({1000, 10, 7}); // reconstructed anew
    EXPECT_EQ(history.points().back().error, 7);
}

TEST(ErrorHistory, SlopeIsThatOfTheLastDecade) {
    std::vector<ErrorPoint> points;
    const auto spp = [](const ErrorPoint& p) { return static_cast<double>(p.spp); };
    EXPECT_EQ(log_slope(points, spp), 0);
    for (int n = 1; n <= 1000; n *= 2)
        points.push_back({n, 1, n < 50 ? 5 : 3.0 / n});
    EXPECT_NEAR(log_slope(points, spp), -1, 1e-9);
}

TEST(Histogram, CountsEveryPixelOnce) {
    RgbImage image(4, 2, Rgb(1));
    image(0, 0) = Rgb(0);
    image(1, 0) = Rgb(-1);
    image(2, 0) = Rgb(NAN);
    image(3, 0) = Rgb(1e30f);
    image(0, 1) = Rgb(1e-20f);
    const Histogram h = histogram_of(image);
    EXPECT_EQ(h.black, 1u);
    EXPECT_EQ(h.negative, 1u);
    EXPECT_EQ(h.not_finite, 1u);
    EXPECT_EQ(h.bins.front(), 1u);
    EXPECT_EQ(h.bins.back(), 1u);
    std::size_t ones = 0;
    for (int bin = 0; bin + 1 < Histogram::bin_count; ++bin)
        if (Histogram::low_end(bin) <= 1.0001f && Histogram::low_end(bin + 1) > 0.9999f)
            ones += h.bins[static_cast<std::size_t>(bin)];
    EXPECT_EQ(ones, 3u);
}

struct Charts : testing::Test, ViewerHarness {
    Charts() { rest(2); }

    void set_reference(Rgb value) {
        auto reference = std::make_shared<Reference>();
        reference->name = "a reference";
        reference->image = RgbImage(48, 36, value);
        state().companions.reference = reference;
    }
};

TEST_F(Charts, ErrorsAreGatheredPassByPass) {
    set_reference(Rgb(0.3f));
    for (int spp : {4, 8, 16}) {
        state().pace.spp_limit = spp;
        wait_until([&] { return viewer.settled(spp); });
        wait_until([&] {
            const auto& a = state().charts[0].errors.points();
            const auto& b = state().charts[1].errors.points();
            return !a.empty() && a.back().spp == spp && !b.empty() && b.back().spp == spp;
        });
    }
    type(Key::h);
    EXPECT_TRUE(state().show_charts);
    wait_until([&] { return state().charts[1].histogram != nullptr; });
    frames(2);
    save("charts.png");
    EXPECT_TRUE(has("charts.errors"));
    EXPECT_TRUE(has("charts.histogram"));
    const std::string csv = chart_csv(state());
    EXPECT_NE(csv.find("1,pt,none,16,"), std::string::npos) << csv;
    EXPECT_NE(csv.find("2,gpr,weighted,16,"), std::string::npos) << csv;
    choose("charts.axis", "spp");
    EXPECT_TRUE(state().charts_by_spp);

    // Another reference, and another request, begin anew.
    set_reference(Rgb(0.5f));
    wait_until([&] { return state().charts[0].reference == state().companions.reference; });
    EXPECT_EQ(state().charts[0].errors.points().size(), 1u);
    state().panes[0].settings.render.max_depth = 2;
    wait_until([&] { return state().charts[0].generation == pane(0).generation; });
    EXPECT_LE(state().charts[0].errors.points().size(), 3u);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(Charts, WithoutAReferenceThereIsAHistogram) {
    type(Key::h);
    wait_until([&] { return state().charts[1].histogram != nullptr; });
    frames(2);
    EXPECT_FALSE(has("charts.errors"));
    const Histogram& h = *state().charts[1].histogram;
    std::size_t sum = h.black + h.negative + h.not_finite;
    for (std::size_t count : h.bins)
        sum += count;
    EXPECT_EQ(sum, 48u * 36u);
}

TEST_F(Charts, AreSavedAsCsv) {
    const std::filesystem::path before = std::filesystem::current_path();
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "tessera-charts-test";
    std::filesystem::create_directories(folder);
    std::filesystem::current_path(folder);
    type(Key::z);
    std::filesystem::current_path(before);
    EXPECT_FALSE(std::filesystem::is_empty(folder));
    EXPECT_EQ(state().messages.back().kind, Message::Kind::note);
    std::filesystem::remove_all(folder);
}

TEST_F(Charts, VariancesAreShownOnALogarithmicScale) {
    type(Key::digit5, false, true);
    EXPECT_EQ(pane(1).settings.buffer, Buffer::primal_variance);
    frames(2);
    EXPECT_TRUE(has("pane0.legend"));
    EXPECT_TRUE(viewer.pane_image(1).range().logarithmic);
    EXPECT_EQ(viewer.pane_image(1).pixels()(20, 20).r, pane(1).snapshot->images->primal_variance(20, 20));
    save("variance.png");
    type(Key::digit6, false, true);
    EXPECT_TRUE(viewer.pane_image(0).empty()); // PT has no gradients
    EXPECT_EQ(viewer.pane_image(1).pixels()(20, 20).r, pane(1).snapshot->images->dx_variance(20, 20));
}

} // namespace
} // namespace tessera::test
