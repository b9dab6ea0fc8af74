#include "recon/metrics/metrics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/ext/vector_double3.hpp>

namespace tessera {

namespace {

double mean_channel(glm::dvec3 c) {
    return (c.r + c.g + c.b) / 3;
}

void check_sizes(const RgbImage& a, const RgbImage& b) {
    if (a.width() != b.width() || a.height() != b.height())
        throw std::invalid_argument("images to compare differ in size");
    if (a.empty())
        throw std::invalid_argument("images to compare are empty");
}

/// Returns the mean without the given fraction of the largest values. NaN counts as the largest.
double trimmed_mean(std::vector<double> values, double fraction) {
    for (double& value : values)
        if (std::isnan(value))
            value = std::numeric_limits<double>::infinity();
    const auto drop = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size()));
    std::nth_element(values.begin(), values.begin() + drop, values.end(), std::greater<>());
    const double sum = std::accumulate(values.begin() + drop, values.end(), 0.0);
    return sum / static_cast<double>(static_cast<std::ptrdiff_t>(values.size()) - drop);
}

} // namespace

ErrorMetrics measure_error(const RgbImage& image, const RgbImage& reference) {
    check_sizes(image, reference);
    const auto count = static_cast<double>(image.size());
    ErrorMetrics metrics;
    std::vector<double> relative(image.size());
    double image_sum = 0, reference_sum = 0, relative_sum = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const glm::dvec3 value = image.data()[i], truth = reference.data()[i];
        const glm::dvec3 error = value - truth;
        relative[i] = mean_channel(error * error / (truth * truth + relative_mse_epsilon));
        relative_sum += relative[i];
        metrics.mse += mean_channel(error * error) / count;
        metrics.mape += mean_channel(glm::abs(error) / (glm::abs(truth) + mape_epsilon)) / count;
        metrics.bad_pixels += !std::isfinite(value.r + value.g + value.b);
        image_sum += mean_channel(value);
        reference_sum += mean_channel(truth);
    }
    metrics.relative_mse = relative_sum / count;
    metrics.relative_mse_trimmed = trimmed_mean(std::move(relative), 1e-4);
    metrics.mean_ratio = image_sum / reference_sum;
    return metrics;
}

std::vector<Piece> pieces_of(const Image<double>& values, int edge) {
    const int columns = (values.width() + edge - 1) / edge;
    const int rows = (values.height() + edge - 1) / edge;
    std::vector<Piece> pieces(static_cast<std::size_t>(columns) * rows);
    for (int y = 0; y < values.height(); ++y) {
        for (int x = 0; x < values.width(); ++x) {
            Piece& piece = pieces[static_cast<std::size_t>(y / edge) * columns + x / edge];
            piece.sum += values(x, y);
            piece.pixels += 1;
        }
    }
    return pieces;
}

/// Treats pieces as independent, since errors of near pixels correlate. The variance is that of a mean over pieces
/// of unequal size [Cochran 1977, 6.4].
FloorFreeError mean_of_pieces(const Image<double>& errors) {
    constexpr int piece_edge = 16, few_pixels = 16 * piece_edge * piece_edge;
    const std::vector<Piece> pieces = pieces_of(errors, errors.size() < few_pixels ? 1 : piece_edge);
    const auto count = static_cast<double>(errors.size());
    const auto piece_count = static_cast<double>(pieces.size());
    FloorFreeError mean;
    for (const Piece& piece : pieces)
        mean.relative_mse += piece.sum / count;
    double variance = 0;
    for (const Piece& piece : pieces)
        variance += std::pow((piece.sum - piece.pixels * mean.relative_mse) / count, 2);
    mean.standard_error = piece_count > 1 ? std::sqrt(variance * piece_count / (piece_count - 1)) : 0;
    return mean;
}

Image<double> floor_free_errors(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2) {
    check_sizes(image, reference1);
    check_sizes(image, reference2);
    Image<double> products(image.width(), image.height());
    for (std::size_t i = 0; i < image.size(); ++i) {
        const glm::dvec3 value = image.data()[i], r1 = reference1.data()[i], r2 = reference2.data()[i];
        const glm::dvec3 r = (r1 + r2) / 2.0;
        products.data()[i] = mean_channel((value - r1) * (value - r2) / (r * r + relative_mse_epsilon));
    }
    return products;
}

Image<double> reference_errors(const RgbImage& reference1, const RgbImage& reference2) {
    check_sizes(reference1, reference2);
    Image<double> squares(reference1.width(), reference1.height());
    for (std::size_t i = 0; i < reference1.size(); ++i) {
        const glm::dvec3 r1 = reference1.data()[i], r2 = reference2.data()[i];
        const glm::dvec3 r = (r1 + r2) / 2.0, half = (r1 - r2) / 2.0;
        squares.data()[i] = mean_channel(half * half / (r * r + relative_mse_epsilon));
    }
    return squares;
}

FloorFreeError measure_floor_free_error(const RgbImage& image, const RgbImage& reference1,
                                        const RgbImage& reference2) {
    return mean_of_pieces(floor_free_errors(image, reference1, reference2));
}

FloorFreeError measure_reference_error(const RgbImage& reference1, const RgbImage& reference2) {
    return mean_of_pieces(reference_errors(reference1, reference2));
}

std::array<double, 4> measure_energy_change(const RgbImage& image, const RgbImage& reference1,
                                            const RgbImage& reference2) {
    check_sizes(image, reference1);
    check_sizes(image, reference2);
    std::array<double, 4> change{};
    std::vector<std::size_t> order(image.size());
    for (const auto& [sorter, judge] : {std::pair{&reference1, &reference2}, {&reference2, &reference1}}) {
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(), [sorter = sorter](std::size_t a, std::size_t b) {
            return luminance(sorter->data()[a]) < luminance(sorter->data()[b]);
        });
        std::array<double, 4> found{}, expected{};
        for (std::size_t i = 0; i < order.size(); ++i) {
            found[4 * i / order.size()] += luminance(image.data()[order[i]]);
            expected[4 * i / order.size()] += luminance(judge->data()[order[i]]);
        }
        for (std::size_t q = 0; q < 4; ++q)
            change[q] += (found[q] / expected[q] - 1) / 2;
    }
    return change;
}

Slope log_log_slope(std::span<const glm::dvec2> points, std::span<const double> relative_errors) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto logarithms = [](const glm::dvec2& p) { return glm::dvec2(std::log(p.x), std::log(p.y)); };
    const auto is_usable = [](const glm::dvec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); };
    double n = 0, x_sum = 0, xx_sum = 0;
    for (const glm::dvec2& point : points)
        if (const glm::dvec2 p = logarithms(point); is_usable(p)) {
            n += 1;
            x_sum += p.x;
            xx_sum += p.x * p.x;
        }
    double spread = 0, rise = 0, error = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (const glm::dvec2 p = logarithms(points[i]); is_usable(p)) {
            const double x = p.x - x_sum / n;
            spread += x * x;
            rise += x * p.y;
            error += std::abs(x) * (relative_errors.empty() ? nan : relative_errors[i]);
        }
    return spread > 1e-9 * xx_sum ? Slope{rise / spread, error / spread} : Slope{nan, nan};
}

} // namespace tessera
