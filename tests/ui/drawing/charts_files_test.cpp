// Charts: efficiency, references, saved files, and large charts.

#include "tests/ui/drawing/charts_fixture.h"
#include "tests/ui/viewer/current_folder.h"
#include "ui/charts/charts.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <imgui.h>
#include <pugixml.hpp>

namespace tessera::test {
namespace {

TEST_F(Charts, EfficiencyIsTheInverseOfErrorTimesSeconds) {
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

TEST_F(Charts, WithoutAReferenceThereAreButtonsToOpenOrMakeOne) {
    type(Key::h);
    frames(2);
    click("charts.make_reference");
    EXPECT_TRUE(state().reference_making.show);
    type(Key::escape);
    click("charts.open_reference");
    EXPECT_EQ(state().layout.choosing, FilePurpose::reference);
}

/// Returns the files of the current folder by extension.
std::map<std::string, std::string> files_here() {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(".")) {
        std::ifstream stream(entry.path(), std::ios::binary);
        files[entry.path().extension().string()] = {std::istreambuf_iterator<char>(stream), {}};
    }
    return files;
}

/// Returns the size in the header of a PNG file.
glm::ivec2 size_of_png(const std::string& png) {
    const auto number = [&](std::size_t at) {
        return (static_cast<unsigned char>(png[at + 2]) << 8) + static_cast<unsigned char>(png[at + 3]);
    };
    return {number(16), number(20)};
}

TEST_F(Charts, AreSavedAsCsvSvgAndPng) {
    const CurrentFolder folder;
    set_reference(Rgb(0.3f));
    for (int spp : {4, 8}) {
        state().rendering.pace.spp_limit = spp;
        wait_until([&] { return viewer.settled(spp); });
    }
    wait_until([&] { return !errors(1).empty(); });
    type(Key::z); // with the panel closed
    finish_saving();
    EXPECT_FALSE(state().wishes.saves.has(SaveKind::charts));
    EXPECT_EQ(state().messages.back().kind, Message::Kind::note);
    EXPECT_NE(state().messages.back().text.find(".csv, .svg and .png"), std::string::npos);
    const auto files = files_here();
    ASSERT_EQ(files.size(), 3u);
    for (const char* header : {"efficiency,not_finite,estimated\n", "seconds,ok,occluded", "luminance,pixels\n"})
        EXPECT_NE(files.at(".csv").find(header), std::string::npos) << header;
    pugi::xml_document svg;
    ASSERT_TRUE(svg.load_string(files.at(".svg").c_str()));
    const auto lines = svg.document_element().children("polyline");
    EXPECT_GE(std::distance(lines.begin(), lines.end()), 2); // at least one line per pane
    for (const char* word : {"1  PT", "2  G-PR", "relMSE", "seconds", "a room"})
        EXPECT_NE(files.at(".svg").find(word), std::string::npos) << word;
    EXPECT_EQ(size_of_png(files.at(".png")).x, static_cast<int>(std::ceil(64 * ImGui::GetFontSize())));
    EXPECT_EQ(state().layout.show_charts, false);
    frames(2);
    EXPECT_FALSE(has("charts.picture"));
}

TEST_F(Charts, AreSavedAfterTheirMeasurement) {
    const CurrentFolder folder;
    viewer.keyboard().press(Key::z, Key::z, false, false);
    frame();
    EXPECT_TRUE(state().charts.histograms_due); // the wish requests them
    EXPECT_TRUE(state().wishes.saves.has(SaveKind::charts));
    finish_saving();
    EXPECT_NE(files_here().at(".csv").find("luminance,pixels"), std::string::npos);
}

TEST_F(Charts, SavedFilesDoNotDependOnTheWindow) {
    set_reference(Rgb(0.3f));
    wait_for_errors(1, 2);
    const auto saved = [&](glm::ivec2 window) {
        const CurrentFolder folder;
        resize(window);
        type(Key::z);
        finish_saving();
        EXPECT_EQ(state().messages.back().kind, Message::Kind::note) << state().messages.back().text;
        return files_here();
    };
    const auto usual = saved({1280, 720});
    EXPECT_EQ(usual.size(), 3u);
    for (const glm::ivec2 window : {glm::ivec2(40, 30), glm::ivec2(1, 1)})
        EXPECT_TRUE(saved(window) == usual) << window.x;
    const ScreenPixels drawn = chart_picture(state());
    EXPECT_GT(std::set<std::uint8_t>(drawn.rgb.begin(), drawn.rgb.end()).size(), 20u); // lines and text
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(Charts, AreDrawnEitherSmallOrLarge) {
    set_reference(Rgb(0.3f));
    state().layout.show_panel = false;
    type(Key::h);
    wait_until([&] { return !errors(1).empty() && state().charts[1].histogram; });
    frames(2);
    const float plot = 10 * ImGui::GetFontSize();
    const auto gap = [&] { return place("charts.large").min.y - place("charts.axis").max.y; };
    EXPECT_GT(gap(), plot);
    click("charts.large");
    frames(2);
    save("charts-large-once.png");
    EXPECT_LT(gap(), plot);               // the buttons follow the choices,
    const ScreenPixels pixels = screen(); // and nothing follows the buttons
    const int x = static_cast<int>(place("charts.large").center().x);
    const int below = static_cast<int>(place("charts.large").max.y) + 8;
    for (int y = below; y < pixels.size.y - 2; ++y)
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_EQ(pixels.at(x, y)[channel], pixels.at(x, below)[channel]) << y;
    click("charts.large");
    frames(2);
    EXPECT_GT(gap(), plot);
    EXPECT_FALSE(has("charts.picture"));
    click("charts.large");
    EXPECT_TRUE(has("charts.picture"));
    type(Key::h);
    frames(2);
    EXPECT_FALSE(has("charts.picture") || has("charts.large")); // nothing covers the pictures
}

TEST_F(Charts, AreDrawnLarge) {
    set_reference(Rgb(0.3f));
    state().layout.show_panel = false;
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
    command("Variance of primal");
    EXPECT_EQ(pane(1).settings.buffer, Buffer::primal_variance);
    frames(2);
    EXPECT_TRUE(has("pane0.legend"));
    EXPECT_TRUE(viewer.pictures().image(1).range().logarithmic);
    EXPECT_EQ(viewer.pictures().image(1).pixels()(20, 20).r, pane(1).snapshot->images->primal_variance(20, 20));
    save("variance.png");
    command("Variance of dx");
    EXPECT_TRUE(viewer.pictures().image(0).empty()); // PT has no gradients
    EXPECT_EQ(viewer.pictures().image(1).pixels()(20, 20).r, pane(1).snapshot->images->dx_variance(20, 20));
}

} // namespace
} // namespace tessera::test
