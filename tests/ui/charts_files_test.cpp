// Charts: efficiency, what they lack, what is saved of them, and how they are drawn large.

#include "tests/ui/charts_fixture.h"
#include "tests/ui/current_folder.h"
#include "ui/chart_file.h"
#include "ui/viewer_charts.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include <gtest/gtest.h>
#include <pugixml.hpp>

namespace tessera::test {
namespace {

TEST_F(Charts, EfficiencyIsTheInverseOfErrorAndTime) {
    set_reference(Rgb(0.3f));
    type(Key::h);
    choose("charts.kind", "efficiency");
    wait_until([&] { return !errors(1).empty(); });
    const ErrorPoint p = errors(1).back();
    const Chart chart = viewer_chart(state());
    ASSERT_EQ(chart.plots.size(), 1u);
    EXPECT_NEAR(chart.plots[0].series[1].points.back().y * p.error * p.seconds, 1, 1e-9);
    frames(2);
    EXPECT_TRUE(has("charts.efficiency"));
    save("charts-efficiency.png");
}

TEST_F(Charts, WithoutAReferenceOneCanBeOpenedOrMade) {
    type(Key::h);
    frames(2);
    click("charts.make_reference");
    EXPECT_TRUE(state().reference_making.show);
    type(Key::escape);
    click("charts.open_reference");
    EXPECT_EQ(state().choosing, FilePurpose::reference);
}

/// The files of the current folder, by their extensions.
std::map<std::string, std::string> files_here() {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(".")) {
        std::ifstream stream(entry.path(), std::ios::binary);
        files[entry.path().extension().string()] = {std::istreambuf_iterator<char>(stream), {}};
    }
    return files;
}

TEST_F(Charts, AreSavedAsCsvSvgAndPng) {
    const CurrentFolder folder;
    set_reference(Rgb(0.3f));
    for (int spp : {4, 8}) {
        state().pace.spp_limit = spp;
        wait_until([&] { return viewer.settled(spp); });
    }
    wait_until([&] { return !errors(1).empty(); });
    type(Key::z); // with the panel closed
    finish_saving();
    EXPECT_FALSE(state().save_charts);
    EXPECT_EQ(state().messages.back().kind, Message::Kind::note);
    EXPECT_NE(state().messages.back().text.find(".csv, .svg and .png"), std::string::npos);
    const auto files = files_here();
    ASSERT_EQ(files.size(), 3u);
    for (const char* header : {"efficiency,not_finite\n", "seconds,ok,occluded", "luminance,pixels\n"})
        EXPECT_NE(files.at(".csv").find(header), std::string::npos) << header;
    pugi::xml_document svg;
    ASSERT_TRUE(svg.load_string(files.at(".svg").c_str()));
    const auto lines = svg.document_element().children("polyline");
    EXPECT_GE(std::distance(lines.begin(), lines.end()), 2); // a line a pane
    for (const char* word : {"1  PT", "2  G-PR", "relMSE", "seconds", "a room"})
        EXPECT_NE(files.at(".svg").find(word), std::string::npos) << word;
    // The picture's size, in the header of a PNG file: that of the place of the panes.
    const std::string& png = files.at(".png");
    const auto number = [&](std::size_t at) {
        return (static_cast<unsigned char>(png[at + 2]) << 8) + static_cast<unsigned char>(png[at + 3]);
    };
    EXPECT_EQ(png.substr(1, 3), "PNG");
    EXPECT_GT(number(16), 700);
    EXPECT_GT(number(20), 600);
    EXPECT_EQ(state().show_charts, false);
    frames(2);
    EXPECT_FALSE(has("charts.picture"));
}

TEST_F(Charts, AreNotSavedBeforeTheyAreMeasured) {
    const CurrentFolder folder;
    viewer.keyboard().press(Key::z, Key::z, false, false);
    frame();
    ASSERT_TRUE(state().save_charts);
    EXPECT_TRUE(state().histograms_due); // the wish alone asks for them
    for (int i = 0; i < 9; ++i)
        EXPECT_FALSE(saver.after_frame(viewer, context.size())); // their end brings a frame
    EXPECT_TRUE(state().save_charts);
    finish_saving();
    EXPECT_EQ(files_here().size(), 3u);
}

TEST_F(Charts, AreDrawnLarge) {
    set_reference(Rgb(0.3f));
    state().show_panel = false;
    type(Key::h);
    wait_until([&] { return !errors(1).empty() && state().charts[1].histogram; });
    click("charts.large");
    frames(2);
    save("charts-large.png");
    EXPECT_TRUE(has("charts.picture"));
    const ControlRect large = place("charts.error");
    EXPECT_GT(large.max.x - large.min.x, 600);
    type(Key::escape);
    frames(2);
    EXPECT_FALSE(has("charts.picture"));
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
