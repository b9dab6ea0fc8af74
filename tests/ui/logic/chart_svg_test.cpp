#include "ui/charts/chart.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

namespace tessera::test {

namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using Scale = ChartAxis::Scale;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<std::string> labels(const ChartAxis& axis) {
    std::vector<std::string> result;
    for (const ChartTick& tick : axis.ticks())
        if (!tick.label.empty())
            result.push_back(tick.label);
    return result;
}

void expect_sound(const ChartAxis& axis, const std::string& what) {
    EXPECT_LT(axis.low(), axis.high()) << what;
    double last = -infinity;
    for (const ChartTick& tick : axis.ticks()) {
        EXPECT_GT(tick.value, last) << what;
        EXPECT_GE(axis.position(tick.value), 0) << what;
        EXPECT_LE(axis.position(tick.value), 1) << what;
        last = tick.value;
    }
    EXPECT_GE(labels(axis).size(), 2u) << what;
    EXPECT_LE(labels(axis).size(), 12u) << what;
}

TEST(ChartAxis, SixDecadesAreLabelledByPowersOfTen) {
    const ChartAxis axis = ChartAxis::spanning(Scale::log, {2e-5, 30});
    EXPECT_EQ(labels(axis), (std::vector<std::string>{"10⁻⁵", "0.0001", "0.001", "0.01", "0.1", "1", "10"}));
    EXPECT_LT(axis.low(), 2e-5);
    EXPECT_GT(axis.high(), 30);
}

TEST(ChartAxis, FewDecadesHaveLabelsBetweenPowersOfTen) {
    EXPECT_EQ(labels(ChartAxis::spanning(Scale::log, {0.011, 0.19})),
              (std::vector<std::string>{"0.01", "0.02", "0.05", "0.1", "0.2"}));
}

TEST(ChartAxis, LinearTicksAreRound) {
    EXPECT_EQ(labels(ChartAxis::spanning(Scale::linear, {2, 12})),
              (std::vector<std::string>{"2", "4", "6", "8", "10", "12"}));
    EXPECT_THAT(labels(ChartAxis::spanning(Scale::linear, {-1, 1})), Contains("0"));
}

TEST(ChartAxis, AnyValuesMakeAValidAxis) {
    const std::vector<std::vector<double>> cases = {
        {},           {nan},          {1},         {0},          {-5},         {1e-300},          {1e300},
        {1, 1},       {1, 1.001},     {1e-9, 1e9}, {infinity},   {0, 1},       {5e9, 5e9 + 1e-6}, {1, 1e-40},
        {0.99, 1.01}, {3e-5, 3.1e-5}, {nan, 0.02}, {0.02, 0.03}, {-1e-7, 1e-7}};
    for (Scale scale : {Scale::linear, Scale::log}) {
        for (const std::vector<double>& values : cases) {
            const ChartAxis axis = ChartAxis::spanning(scale, values);
            const std::string what = testing::PrintToString(values) + (scale == Scale::log ? " log" : " linear");
            expect_sound(axis, what);
            for (double value : values) {
                if (axis.has(value)) {
                    EXPECT_GT(axis.position(value), 0) << what;
                    EXPECT_LT(axis.position(value), 1) << what;
                }
            }
        }
    }
}

TEST(ChartNumber, HasAtMostFourDigits) {
    EXPECT_EQ(chart_number(0), "0");
    EXPECT_EQ(chart_number(-0.0), "0");
    EXPECT_EQ(chart_number(0.0005), "0.0005");
    EXPECT_EQ(chart_number(12), "12");
    EXPECT_EQ(chart_number(-2.5e-12), "-2.5·10⁻¹²");
    EXPECT_EQ(chart_number(16000), "16000");
    EXPECT_EQ(chart_number(1e5), "10⁵");
}

Chart two_plots(const std::vector<ChartSeries>& left, const std::vector<ChartSeries>& right) {
    return {"A <chart> & its \"title\"",
            {{"x", "left", Scale::linear, Scale::log, {}, left},
             {"x", "right", Scale::log, Scale::linear, {}, right}}};
}

pugi::xml_document parse(const std::string& svg) {
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_string(svg.c_str());
    EXPECT_TRUE(result) << result.description() << "\n" << svg;
    EXPECT_STREQ(document.document_element().name(), "svg");
    return document;
}

std::vector<std::string> texts(const pugi::xml_document& document) {
    std::vector<std::string> result;
    for (const pugi::xml_node& node : document.document_element().children("text"))
        result.emplace_back(node.text().get());
    return result;
}

std::ptrdiff_t count(const pugi::xml_document& document, const char* name) {
    const auto nodes = document.document_element().children(name);
    return std::distance(nodes.begin(), nodes.end());
}

TEST(Chart, ContainsEachSeriesAndLabel) {
    const std::string svg =
        to_svg(two_plots({{"a < b", {{1, 0.1, 0.02}, {2, 0.01}}}, {"level", {{0, 0.03}}, true}},
                         {{"a < b", {{1, 5}, {2, 6}, {3, 7}}}, {"third", {{3, 3}}}}));
    const pugi::xml_document document = parse(svg);
    for (const char* text : {"A <chart> & its \"title\"", "left", "right", "x", "a < b", "level", "third"})
        EXPECT_THAT(texts(document), Contains(text));
    EXPECT_EQ(count(document, "polyline"), 3) << "one polyline per series except the level";
    // Circles: the five points of the first series, and its marker in the key.
    EXPECT_EQ(count(document, "circle"), 6);
    EXPECT_THAT(svg, HasSubstr("stroke-dasharray"));
}

TEST(Chart, SkipsPointsThatAxesCannotShow) {
    const std::vector<ChartSeries> odd = {{"a", {{1, nan}, {2, -1}, {3, 0}, {infinity, 1}, {4, 0.5, nan}}},
                                          {"b", {{1, infinity}, {5, 0.25, 0.5}, {6, 0.1, infinity}}},
                                          {"c", {{0, nan}}, true},
                                          {"d", {}},
                                          {"e", {}, true}};
    for (const Chart& chart : {two_plots(odd, odd), two_plots({}, {}), Chart{"", {}}}) {
        const std::string svg = to_svg(chart);
        parse(svg);
        EXPECT_THAT(svg, Not(HasSubstr("nan")));
        EXPECT_THAT(svg, Not(HasSubstr("inf")));
    }
}

TEST(Chart, PointsAndBarsLieInTheFrame) {
    const Chart chart{
        "t", {{"x", "y", Scale::linear, Scale::log, {}, {{"a", {{1, 1, 5}, {3, 1e-6, 1e-7}, {2, 1e3}}}}}}};
    const pugi::xml_document document = parse(to_svg(chart));
    const pugi::xml_node frame = document.document_element().find_child_by_attribute("rect", "fill", "none");
    const double left = frame.attribute("x").as_double(), right = left + frame.attribute("width").as_double();
    const double top = frame.attribute("y").as_double(), bottom = top + frame.attribute("height").as_double();
    int inside = 0;
    for (const pugi::xml_node& circle : document.document_element().children("circle")) {
        const double x = circle.attribute("cx").as_double(), y = circle.attribute("cy").as_double();
        inside += x > left && x < right && y > top && y < bottom;
    }
    EXPECT_EQ(inside, 3);
    int bars = 0;
    for (const pugi::xml_node& line : document.document_element().children("line")) {
        const double x = line.attribute("x1").as_double();
        if (x != line.attribute("x2").as_double() || line.attribute("y1").as_double() >= bottom)
            continue;
        ++bars;
        EXPECT_GE(line.attribute("y1").as_double(), top);
        EXPECT_LE(line.attribute("y2").as_double(), bottom);
    }
    EXPECT_EQ(bars, 2);
    // The line goes from left to right for any order of the points.
    EXPECT_THAT(document.document_element().child("polyline").attribute("points").value(),
                testing::ContainsRegex("^[0-9.]+,[0-9.]+ [0-9.]+,[0-9.]+ [0-9.]+,[0-9.]+ $"));
    double last = 0;
    std::istringstream points(document.document_element().child("polyline").attribute("points").value());
    for (std::string point; points >> point;) {
        EXPECT_GT(std::stod(point), last);
        last = std::stod(point);
    }
}

TEST(Chart, MethodsAndNormsHaveDistinctStyles) {
    std::vector<ChartSeries> lines;
    for (Method method : all_methods)
        for (Norm norm : all_norms)
            for (int marker = 0; marker < (has_gradients(method) || norm == Norm::none ? 2 : 0); ++marker)
                lines.push_back(
                    {std::to_string(lines.size()), {{1, 1}, {2, 1}}, false, true, {method, norm, marker}});
    ASSERT_GT(lines.size(), 20u);
    const pugi::xml_document document = parse(to_svg({"t", {{"x", "y", Scale::log, Scale::log, {}, lines}}}));
    std::set<std::string> strokes;
    std::set<std::pair<std::string, std::string>> dashes;
    for (const pugi::xml_node& line : document.document_element().children("polyline")) {
        strokes.insert(line.attribute("stroke").value());
        dashes.emplace(line.attribute("stroke").value(), line.attribute("stroke-dasharray").value());
    }
    EXPECT_EQ(strokes.size(), std::size(all_methods)) << "one colour per method";
    EXPECT_EQ(dashes.size(), 2 + 2 * all_norms.size()) << "dashes show the norms that apply to the method";
    EXPECT_GT(count(document, "circle"), 0);
    EXPECT_EQ(count(document, "circle") + 2, count(document, "rect"))
        << "background, frame, and the square markers";
}

TEST(Chart, NamesAreTicksAtIntegers) {
    const Chart chart{
        "t", {{"shift", "y", Scale::log, Scale::log, {"half-vector", "replay"}, {{"a", {{0, 1}, {1, 2}}}}}}};
    const std::vector<std::string> all = texts(parse(to_svg(chart)));
    EXPECT_THAT(all, Contains("half-vector"));
    EXPECT_THAT(all, Contains("replay"));
}

} // namespace

} // namespace tessera::test
