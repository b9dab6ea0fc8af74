// Counters of a render in the viewer: maps and panel.

#include "tests/support/scene_builder.h"
#include "tests/ui/drawing/panes_fixture.h"
#include "ui/gl/theme.h"
#include "ui/gl/tone.h"
#include "ui/panels/panels.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace tessera::test {
namespace {

struct CountersView : Panes {
    /// Expects the right pane to show the map in false colours from 0 to `top`.
    void expect_map(const Image<float>& map, float top);
};

glm::vec3 false_colour(float share) {
    const float place = std::min(share, 1.0f) * static_cast<float>(false_colours.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), false_colours.size() - 2);
    return 255.0f * glm::mix(false_colours[below], false_colours[below + 1], place - static_cast<float>(below));
}

void CountersView::expect_map(const Image<float>& map, float top) {
    const ScreenPixels pixels = screen();
    for (int y = 0; y < map.height(); y += 5) {
        for (int x = 0; x < map.width(); x += 5) {
            const glm::vec3 seen = colour(pixels, middle_of(1, x, y));
            EXPECT_LT(glm::distance(seen, false_colour(map(x, y) / top)), 4) << x << ',' << y;
        }
    }
}

TEST_F(CountersView, KeysShowTheMaps) {
    EXPECT_FALSE(has("pane1.legend"));
    const auto maps = pane(1).snapshot->reuse;
    ASSERT_NE(maps, nullptr);
    const Image<float> reused = maps->reused();
    EXPECT_GT(*std::max_element(reused.begin(), reused.end()), 1);

    type(Key::digit5);
    RgbImage scratch;
    expect_map(reused, top_value(Buffer::reused, picture(*pane(1).snapshot, Buffer::reused, scratch)));
    EXPECT_TRUE(has("pane1.legend"));
    save("reused.png");
    command("Roulette survival");
    expect_map(maps->survival(), 1);
    EXPECT_TRUE(has("pane1.legend"));
    save("survival.png");
    type(Key::digit1);
    EXPECT_FALSE(has("pane1.legend"));
}

TEST_F(CountersView, LegendShowsItsColoursWithinThePicture) {
    type(Key::digit5);
    const ControlRect legend = place("pane1.legend"), picture = place("pane1.picture");
    EXPECT_GT(legend.min.x, picture.min.x);
    EXPECT_LT(legend.max.y, picture.max.y);
    const ScreenPixels pixels = screen();
    float least = 255, most = 0; // green channel of the bar
    for (float x = legend.min.x + 9; x < legend.max.x - 9; ++x) {
        const float green = pixels.at(static_cast<int>(x), static_cast<int>(legend.max.y) - 10)[1];
        least = std::min(least, green);
        most = std::max(most, green);
    }
    EXPECT_LT(least, 12);
    EXPECT_GT(most, 230);
}

TEST_F(CountersView, PathTracingHasNoMaps) {
    EXPECT_EQ(pane(0).snapshot->reuse, nullptr);
    for (Key key : {Key::digit5, Key::digit6}) {
        type(key);
        EXPECT_TRUE(viewer.pictures().image(0).empty());
        EXPECT_FALSE(viewer.pictures().image(1).empty());
        EXPECT_FALSE(has("pane0.legend"));
    }
}

TEST_F(CountersView, NoLegendWithoutSpace) {
    type(Key::digit5);
    resize({360, 200});
    EXPECT_FALSE(has("pane1.legend"));
    EXPECT_TRUE(has("pane1.picture"));
}

TEST_F(CountersView, PanelShowsTheFiguresOfTheActivePane) {
    EXPECT_FALSE(has("statistics.spp"));
    type(Key::t);
    const Counters& c = pane(1).snapshot->counters;
    EXPECT_GE(c.camera_paths, 3u * 48 * 36);
    for (const StatisticGroup& group : statistics(*pane(1).snapshot)) {
        for (const Statistic& figure : group.statistics) {
            EXPECT_TRUE(has("statistics." + figure.id)) << figure.id;
            if (figure.id == "camera_paths") {
                EXPECT_EQ(figure.value, std::to_string(c.camera_paths));
            } else if (figure.id == "shifts.ok") {
                EXPECT_DOUBLE_EQ(*figure.share,
                                 static_cast<double>(c.shifts[0]) / static_cast<double>(c.shift_attempts()));
            } else if (figure.id == "reused") {
                EXPECT_DOUBLE_EQ(*figure.share,
                                 static_cast<double>(c.reused_paths) / static_cast<double>(c.set_paths()));
            }
        }
    }
    EXPECT_TRUE(has("statistics.shifts.ok"));
    EXPECT_TRUE(has("tile")); // the settings are above
    save("statistics.png");

    click("pane0.picture");
    EXPECT_TRUE(has("statistics.rays.camera"));
    EXPECT_FALSE(has("statistics.shifts.ok"));
    type(Key::t);
    EXPECT_FALSE(has("statistics.spp"));
}

TEST_F(CountersView, PanelDrawsFractionsAsBars) {
    type(Key::p); // closes the settings, so that nothing is scrolled away
    type(Key::t);
    ASSERT_TRUE(wait_until([&] { return viewer.settled(3); })); // the size has changed
    const Snapshot& snapshot = *pane(1).snapshot;
    const double share =
        static_cast<double>(snapshot.counters.rays[static_cast<std::size_t>(RayKind::shift_edge)]) /
        static_cast<double>(snapshot.counters.all_rays());
    const ControlRect row = place("statistics.rays.shift_edge");
    const ImVec4 colour = ImGui::ColorConvertU32ToFloat4(method_colour(Method::gpr));
    const ScreenPixels pixels = screen();
    int filled = 0, width = 0;
    for (float x = row.min.x + (row.max.x - row.min.x) * 0.83f; x < row.max.x - 1; ++x, ++width) {
        const std::uint8_t* p = pixels.at(static_cast<int>(x), static_cast<int>(row.center().y) + 1);
        filled += std::abs(p[1] - 255 * colour.y) < 3;
    }
    EXPECT_NEAR(filled, share * width, 3);
    EXPECT_GT(filled, 0);
    EXPECT_LT(filled, width);
}

TEST_F(CountersView, FiguresAndLegendExplainThemselves) {
    type(Key::digit5);
    type(Key::t);
    for (const char* control : {"statistics.skipped", "pane1.legend"}) {
        move_to(place(control).center());
        EXPECT_TRUE(viewer.controls().tooltip_pending()) << control;
        const auto before = screen();
        frames(40);
        EXPECT_NE(before.rgb, screen().rgb) << control;
        save(std::string("tooltip-") + control + ".png");
    }
}

TEST_F(CountersView, PanelIsInTheMenuAndScrolls) {
    click("menu View");
    click("menu View/Statistics");
    EXPECT_TRUE(state().layout.show_statistics);
    const float before = place("statistics.spp").min.y;
    move_to(place("statistics.spp").center());
    wheel(-3);
    EXPECT_LT(place("statistics.spp").min.y, before);
}

TEST(StatisticsPanel, IsHarmlessBeforeAnyScene) {
    ViewerHarness h;
    h.state().layout.show_statistics = true;
    h.frames(3);
    EXPECT_FALSE(h.has("statistics.spp"));
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(200, 20), glm::ivec2(60, 60)}) {
        h.resize(size);
        h.frames(2);
    }
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

} // namespace
} // namespace tessera::test
