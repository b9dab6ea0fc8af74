#include "render/film/pixel_features.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// Returns the sample variance of n points, from the sum of their squares and the square of their sum.
double variance_of(double squares, double square_of_sum, double n) {
    return n > 1 ? std::max(squares - square_of_sum / n, 0.0) / (n - 1) : 0;
}

float square_of(const SurfaceFeatures& features) {
    return glm::dot(features.albedo, features.albedo) + glm::dot(features.normal, features.normal) +
           features.roughness * features.roughness;
}

bool is_good(const FeatureSample& sample) {
    return is_finite(sample.albedo) && is_finite(sample.features.albedo) && is_finite(sample.features.normal) &&
           std::isfinite(sample.features.nearness) && std::isfinite(sample.features.roughness);
}

} // namespace

bool PixelFeatures::add(int x, int y, const FeatureSample& sample) {
    const bool good = is_good(sample);
    points_(x, y) += good ? sample : FeatureSample{};
    --points_(x, y).wanted;
    return good;
}

void PixelFeatures::Points::operator+=(const FeatureSample& sample) {
    const glm::dvec3 a(sample.albedo);
    albedo += a;
    albedo_squares += glm::dot(a, a);
    features += sample.features;
    feature_squares += square_of(sample.features);
    ++count;
}

void PixelFeatures::Points::operator+=(const Points& other) {
    albedo += other.albedo;
    albedo_squares += other.albedo_squares;
    features += other.features;
    feature_squares += other.feature_squares;
    count += other.count;
}

double PixelFeatures::Points::relative_albedo_variance() const {
    const double n = count, square = glm::dot(albedo, albedo);
    return variance_of(albedo_squares, square, n) / std::max(square / std::max(n * n, 1.0), 1e-30);
}

double PixelFeatures::Points::feature_variance() const {
    return variance_of(static_cast<double>(feature_squares), static_cast<double>(square_of(features)), count);
}

PixelFeatures::Points PixelFeatures::around(int x, int y) const {
    Points sum;
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, points_.height() - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, points_.width() - 1); ++i)
            sum += points_(i, j);
    return sum;
}

void PixelFeatures::request_more(int passes) {
    // The albedo's relative variance must be well below that of radiance, which is 0.1 to 1 for one sample. The
    // variance of features must be well below the squared widths of reconstruction (43).
    constexpr double albedo_limit = 0.004, feature_limit = 0.003;
    constexpr double most = 1 << 20;
    const auto needed = [](double variance, double limit) { return std::pow(variance / limit, 2 / 3.0); };
    for (int y = 0; y < points_.height(); ++y)
        for (int x = 0; x < points_.width(); ++x) {
            const Points near = around(x, y);
            Points& here = points_(x, y);
            double count = needed(near.feature_variance(), feature_limit);
            if (for_albedo_)
                count = std::max(count, needed(near.relative_albedo_variance(), albedo_limit / passes));
            here.wanted = static_cast<int>(std::clamp(count - here.count, 0.0, most));
        }
}

Image<std::uint8_t> PixelFeatures::mixed() const {
    constexpr double noticeable = 0.2; // insensitive: 0.05 to 0.6 have about the same error and cost
    Image<std::uint8_t> result(points_.width(), points_.height());
    for (int y = 0; y < points_.height(); ++y)
        for (int x = 0; x < points_.width(); ++x)
            result(x, y) = around(x, y).feature_variance() > noticeable;
    return result;
}

void PixelFeatures::take_more_of(const PixelFeatures& other) {
    std::transform(points_.begin(), points_.end(), other.points_.begin(), points_.begin(),
                   [](const Points& a, const Points& b) { return b.count > a.count ? b : a; });
}

Rgb PixelFeatures::albedo(std::size_t i) const {
    const Points& points = points_.data()[i];
    return Rgb(points.albedo / static_cast<double>(std::max(points.count, 1)));
}

float PixelFeatures::albedo_variance(std::size_t i) const {
    const Points& points = points_.data()[i];
    return static_cast<float>(
        variance_of(points.albedo_squares, glm::dot(points.albedo, points.albedo), points.count));
}

FeatureImages PixelFeatures::images() const {
    const int width = points_.width(), height = points_.height();
    FeatureImages result{RgbImage(width, height), RgbImage(width, height), Image<float>(width, height),
                         Image<float>(width, height)};
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const SurfaceFeatures& sum = points_.data()[i].features;
        const auto n = static_cast<float>(std::max(points_.data()[i].count, 1));
        result.albedo.data()[i] = sum.albedo / n;
        result.normal.data()[i] = sum.normal / n;
        result.nearness.data()[i] = sum.nearness / n;
        result.roughness.data()[i] = sum.roughness / n;
    }
    return result;
}

} // namespace tessera
