// Slopes of curves of error over time, in logarithmic scales.
#include "recon/metrics/metrics.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {
namespace {

TEST(Slope, IsTheExponent) {
    std::vector<glm::dvec2> points;
    for (double x = 0.01; x < 1000; x *= 1.7)
        points.emplace_back(x, 3 * std::pow(x, -0.75));
    EXPECT_NEAR(log_log_slope(points).value, -0.75, 1e-12);
}

TEST(Slope, LeavesOutPointsWithoutALogarithm) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
    const std::vector<glm::dvec2> points = {{1, 8},  {2, 4},        {4, 2}, {0, 1},   {-1, 3},
                                            {3, -1}, {3, infinity}, {3, 0}, {nan, 1}, {5, nan}};
    EXPECT_NEAR(log_log_slope(points).value, -1, 1e-12);
}

/// For two points a factor of e apart, the slope is the difference of their logarithms, and its error at most the
/// sum of their errors. Points without a logarithm do not count. Without errors of points, the error is NaN.
TEST(Slope, ErrorIsTheSumOfTheErrorsOfPoints) {
    const std::vector<glm::dvec2> points = {{1, 5}, {0, 1}, {std::numbers::e, 4}};
    const std::vector<double> errors = {0.1, 9, 0.2};
    EXPECT_NEAR(log_log_slope(points, errors).value, std::log(0.8), 1e-12);
    EXPECT_NEAR(log_log_slope(points, errors).error, 0.3, 1e-12);
    EXPECT_TRUE(std::isnan(log_log_slope(points).error));
}

TEST(Slope, OfFewerThanTwoAbscissasIsNaN) {
    const std::vector<glm::dvec2> one = {{2, 1}}, same = {{2, 1}, {2, 3}, {2, 5}}, useless = {{2, 1}, {3, 0}};
    EXPECT_TRUE(std::isnan(log_log_slope({}).value));
    EXPECT_TRUE(std::isnan(log_log_slope(one).value));
    EXPECT_TRUE(std::isnan(log_log_slope(same).value));
    EXPECT_TRUE(std::isnan(log_log_slope(useless).value));
}

} // namespace
} // namespace tessera::test
