#include "render/film/pixel_looks.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// Of one of n points, by the sum of their squares and the square of their sum.
double variance_of(double squares, double square_of_sum, double n) {
    return n > 1 ? std::max(squares - square_of_sum / n, 0.0) / (n - 1) : 0;
}

float square_of(const Guide& guide) {
    return glm::dot(guide.albedo, guide.albedo) + glm::dot(guide.normal, guide.normal) +
           guide.roughness * guide.roughness;
}

bool is_good(const Look& look) {
    return is_finite(look.albedo) && is_finite(look.guide.albedo) && is_finite(look.guide.normal) &&
           std::isfinite(look.guide.nearness) && std::isfinite(look.guide.roughness);
}

} // namespace

bool PixelLooks::add(int x, int y, const Look& look) {
    const bool good = is_good(look);
    points_(x, y) += good ? look : Look{};
    --points_(x, y).wanted;
    return good;
}

void PixelLooks::Points::operator+=(const Look& look) {
    const glm::dvec3 a(look.albedo);
    albedo += a;
    albedo_squares += glm::dot(a, a);
    guide += look.guide;
    guide_squares += square_of(look.guide);
    ++count;
}

void PixelLooks::Points::operator+=(const Points& other) {
    albedo += other.albedo;
    albedo_squares += other.albedo_squares;
    guide += other.guide;
    guide_squares += other.guide_squares;
    count += other.count;
}

double PixelLooks::Points::relative_albedo_variance() const {
    const double n = count, square = glm::dot(albedo, albedo);
    return variance_of(albedo_squares, square, n) / std::max(square / std::max(n * n, 1.0), 1e-30);
}

double PixelLooks::Points::guide_variance() const {
    return variance_of(static_cast<double>(guide_squares), static_cast<double>(square_of(guide)), count);
}

PixelLooks::Points PixelLooks::around(int x, int y) const {
    Points sum;
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, points_.height() - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, points_.width() - 1); ++i)
            sum += points_(i, j);
    return sum;
}

void PixelLooks::ask_for_more(int passes) {
    // The albedo's relative variance is to be well below that of the light, of which a sample has about 0.1 to 1
    // before the pixels around help. Tried on stability's texture: 0.002 is as good, 0.015 costs a fifth more
    // time. Guides are to be known well beside what counts as alike (recon/picture/guide_kernel.cpp).
    constexpr double enough_of_one = 0.004, enough_of_guides = 0.003;
    constexpr double most = 1 << 20;
    const auto needed = [](double variance, double enough) { return std::pow(variance / enough, 2 / 3.0); };
    for (int y = 0; y < points_.height(); ++y)
        for (int x = 0; x < points_.width(); ++x) {
            const Points near = around(x, y);
            Points& here = points_(x, y);
            double count = needed(near.guide_variance(), enough_of_guides);
            if (for_albedo_)
                count = std::max(count, needed(near.relative_albedo_variance(), enough_of_one / passes));
            here.wanted = static_cast<int>(std::clamp(count - here.count, 0.0, most));
        }
}

Image<std::uint8_t> PixelLooks::mixed() const {
    constexpr double noticeable = 0.2; // 0.05 to 0.6 bring and cost about the same
    Image<std::uint8_t> result(points_.width(), points_.height());
    for (int y = 0; y < points_.height(); ++y)
        for (int x = 0; x < points_.width(); ++x)
            result(x, y) = around(x, y).guide_variance() > noticeable;
    return result;
}

void PixelLooks::take_more_of(const PixelLooks& other) {
    std::transform(points_.begin(), points_.end(), other.points_.begin(), points_.begin(),
                   [](const Points& a, const Points& b) { return b.count > a.count ? b : a; });
}

Rgb PixelLooks::albedo(std::size_t i) const {
    const Points& points = points_.data()[i];
    return Rgb(points.albedo / static_cast<double>(std::max(points.count, 1)));
}

float PixelLooks::albedo_variance(std::size_t i) const {
    const Points& points = points_.data()[i];
    return static_cast<float>(
        variance_of(points.albedo_squares, glm::dot(points.albedo, points.albedo), points.count));
}

GuideImages PixelLooks::guides() const {
    const int width = points_.width(), height = points_.height();
    GuideImages result{RgbImage(width, height), RgbImage(width, height), Image<float>(width, height),
                       Image<float>(width, height)};
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const Guide& sum = points_.data()[i].guide;
        const auto n = static_cast<float>(std::max(points_.data()[i].count, 1));
        result.albedo.data()[i] = sum.albedo / n;
        result.normal.data()[i] = sum.normal / n;
        result.nearness.data()[i] = sum.nearness / n;
        result.roughness.data()[i] = sum.roughness / n;
    }
    return result;
}

} // namespace tessera
