#include "recon/metrics/seen_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

void check_sizes(const RgbImage& a, const RgbImage& b) {
    if (a.empty() || a.width() != b.width() || a.height() != b.height())
        throw std::invalid_argument("pictures to compare must be of one size, and not empty");
}

glm::dvec3 shown(Rgb c) {
    const Rgb v = glm::clamp(c, Rgb(0), Rgb(1));
    return {linear_to_srgb(v.r), linear_to_srgb(v.g), linear_to_srgb(v.b)};
}

// FLIP, step by step with the constants of [Andersson 2020, 4].

using Plane = Image<double>;
using Colours = Image<glm::dvec3>;

constexpr double pixels_a_degree = 0.7 * 3840 / 0.7 * std::numbers::pi / 180;

/// Matrix from linear sRGB to XYZ, column by column, with white (0.9504..., 1, 1.0889...).
const glm::dmat3 xyz_of_linear = glm::dmat3{{10135552, 6 * 871024.0, 475104},
                                            {8788810, 2 * 8788810.0, 8788810 / 3.0},
                                            {4435075, 2 * 887015.0, 70074185 / 3.0}} /
                                 24577794.0;
const glm::dmat3 linear_of_xyz = glm::inverse(xyz_of_linear);
const glm::dvec3 white = xyz_of_linear * glm::dvec3(1);

/// Converts linear sRGB to YyCxCz: lightness and two opponents, linear in light.
glm::dvec3 opponents_of(glm::dvec3 linear) {
    const glm::dvec3 n = xyz_of_linear * linear / white;
    return {116 * n.y - 16, 500 * (n.x - n.y), 200 * (n.y - n.z)};
}

glm::dvec3 linear_of(glm::dvec3 opponents) {
    const double y = (opponents.x + 16) / 116;
    return linear_of_xyz * (glm::dvec3(y + opponents.y / 500, y, y - opponents.z / 200) * white);
}

/// Converts to L*a*b*, with a and b scaled by lightness after the Hunt effect [Hunt 1952].
glm::dvec3 lab_of(glm::dvec3 linear) {
    constexpr double delta = 6 / 29.0;
    const glm::dvec3 n = xyz_of_linear * linear / white;
    glm::dvec3 f;
    for (int c = 0; c < 3; ++c)
        f[c] = n[c] > delta * delta * delta ? std::cbrt(n[c]) : n[c] / (3 * delta * delta) + 4 / 29.0;
    const double lightness = 116 * f.y - 16;
    return {lightness, 0.01 * lightness * 500 * (f.x - f.y), 0.01 * lightness * 200 * (f.y - f.z)};
}

/// Returns the HyAB distance [Abasi 2020].
double distance_of(glm::dvec3 a, glm::dvec3 b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// One-dimensional kernel, from -r to r.
using Kernel = std::vector<double>;

template <class Value>
Kernel kernel_of(int radius, Value value) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i)
        kernel.push_back(value(static_cast<double>(i)));
    return kernel;
}

/// Filters along rows with one kernel and along columns with the other. Border pixels are repeated.
template <class Pixel>
Image<Pixel> filtered(const Image<Pixel>& image, const Kernel& along_x, const Kernel& along_y,
                      const ParallelFor& parallel_for) {
    const int width = image.width(), height = image.height(), radius = static_cast<int>(along_x.size() / 2);
    Image<Pixel> rows(width, height), result(width, height);
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            Pixel sum(0);
            for (int i = -radius; i <= radius; ++i)
                sum += along_x[static_cast<std::size_t>(i + radius)] * image(std::clamp(x + i, 0, width - 1), y);
            rows(x, y) = sum;
        }
    });
    parallel_for(height, [&](int y) {
        for (int j = -radius; j <= radius; ++j) {
            const Pixel* row = rows.row(std::clamp(y + j, 0, height - 1));
            const double weight = along_y[static_cast<std::size_t>(j + radius)];
            for (int x = 0; x < width; ++x)
                result(x, y) += weight * row[x];
        }
    });
    return result;
}

/// Filters each opponent with its contrast sensitivity function, a sum of Gaussians a sqrt(pi / b) exp(-pi^2 x^2 /
/// b) over degrees x.
Colours csf_filtered(const Colours& opponents, const ParallelFor& parallel_for) {
    struct Gaussian {
        double a, b;
    };
    constexpr std::array<std::array<Gaussian, 2>, 3> sensitivities{
        {{{{1, 0.0047}, {0, 1e-5}}}, {{{1, 0.0053}, {0, 1e-5}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};
    const int radius = static_cast<int>(
        std::ceil(3 * std::sqrt(0.04 / (2 * std::numbers::pi * std::numbers::pi)) * pixels_a_degree));
    Colours result(opponents.width(), opponents.height(), glm::dvec3(0));
    for (int c = 0; c < 3; ++c) {
        Plane plane(opponents.width(), opponents.height());
        std::transform(opponents.begin(), opponents.end(), plane.begin(), [c](glm::dvec3 v) { return v[c]; });
        double all = 0;
        Plane sum(plane.width(), plane.height());
        for (const auto& [a, b] : sensitivities[static_cast<std::size_t>(c)]) {
            if (a == 0)
                continue;
            const Kernel kernel = kernel_of(radius, [b = b](double x) {
                const double degrees = x / pixels_a_degree;
                return std::exp(-std::numbers::pi * std::numbers::pi * degrees * degrees / b);
            });
            double weight = 0;
            for (double k : kernel)
                weight += k;
            const double factor = a * std::sqrt(std::numbers::pi / b);
            all += factor * weight * weight;
            const Plane part = filtered(plane, kernel, kernel, parallel_for);
            for (std::size_t i = 0; i < sum.size(); ++i)
                sum.data()[i] += factor * part.data()[i];
        }
        for (std::size_t i = 0; i < sum.size(); ++i)
            result.data()[i][c] = sum.data()[i] / all;
    }
    return result;
}

/// Returns the colour differences of FLIP, in [0, 1].
Plane colour_differences(const Colours& a, const Colours& b, const ParallelFor& parallel_for) {
    constexpr double power = 0.7, knee = 0.4, knee_value = 0.95; // [0, knee] is mapped to [0, knee_value]
    const double largest = std::pow(distance_of(lab_of({0, 1, 0}), lab_of({0, 0, 1})), power);
    const Colours seen_a = csf_filtered(a, parallel_for), seen_b = csf_filtered(b, parallel_for);
    const auto lab = [](glm::dvec3 opponents) { return lab_of(glm::clamp(linear_of(opponents), 0.0, 1.0)); };
    Plane result(a.width(), a.height());
    parallel_for(a.height(), [&](int y) {
        for (int x = 0; x < a.width(); ++x) {
            const double d = std::pow(distance_of(lab(seen_a(x, y)), lab(seen_b(x, y))), power) / largest;
            result(x, y) =
                d < knee ? knee_value / knee * d : knee_value + (d - knee) / (1 - knee) * (1 - knee_value);
        }
    });
    return result;
}

/// Scales positive and negative weights so that each group sums to one in magnitude.
void balance(Kernel& kernel) {
    double positive = 0, negative = 0;
    for (double k : kernel)
        (k > 0 ? positive : negative) += std::abs(k);
    for (double& k : kernel)
        k /= k > 0 ? positive : negative;
}

/// Returns differences of edges, or of points: of the lengths of first, or second, Gaussian derivatives of
/// lightness in [0, 1].
Plane feature_differences(const Plane& a, const Plane& b, bool points, const ParallelFor& parallel_for) {
    const double deviation = 0.5 * 0.082 * pixels_a_degree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto gaussian = [deviation](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
    Kernel smooth = kernel_of(radius, gaussian),
           change = kernel_of(radius, [&](double x) {
               return (points ? x * x / (deviation * deviation) - 1 : -x) * gaussian(x);
           });
    balance(smooth);
    balance(change);
    const auto lengths = [&](const Plane& plane) {
        const Plane x = filtered(plane, change, smooth, parallel_for),
                    y = filtered(plane, smooth, change, parallel_for);
        Plane length(plane.width(), plane.height());
        for (std::size_t i = 0; i < length.size(); ++i)
            length.data()[i] = std::hypot(x.data()[i], y.data()[i]);
        return length;
    };
    Plane result = lengths(a);
    const Plane other = lengths(b);
    for (std::size_t i = 0; i < result.size(); ++i)
        result.data()[i] = std::abs(result.data()[i] - other.data()[i]);
    return result;
}

/// Returns the opponents of the displayed linear light, clipped to [0, 1].
Colours shown_opponents(const RgbImage& image) {
    Colours result(image.width(), image.height());
    std::transform(image.begin(), image.end(), result.begin(),
                   [](Rgb c) { return opponents_of(glm::clamp(glm::dvec3(c), 0.0, 1.0)); });
    return result;
}

Plane lightness_of(const Colours& opponents) {
    Plane result(opponents.width(), opponents.height());
    std::transform(opponents.begin(), opponents.end(), result.begin(),
                   [](glm::dvec3 v) { return (v.x + 16) / 116; });
    return result;
}

} // namespace

double psnr(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2) {
    check_sizes(image, reference1);
    check_sizes(image, reference2);
    double sum = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const glm::dvec3 here = shown(image.data()[i]);
        sum += glm::dot(here - shown(reference1.data()[i]), here - shown(reference2.data()[i]));
    }
    const double mean = sum / (3 * static_cast<double>(image.size()));
    return mean >= 0 ? -10 * std::log10(mean) : std::nan(""); // infinite for 0
}

Image<float> flip(const RgbImage& image, const RgbImage& reference, const ParallelFor& parallel_for) {
    check_sizes(image, reference);
    const Colours a = shown_opponents(reference), b = shown_opponents(image);
    const Plane colours = colour_differences(a, b, parallel_for);
    const Plane dark = lightness_of(a), bright = lightness_of(b);
    const Plane edges = feature_differences(dark, bright, false, parallel_for);
    const Plane points = feature_differences(dark, bright, true, parallel_for);
    Image<float> result(image.width(), image.height());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double feature = std::sqrt(std::max(edges.data()[i], points.data()[i]) / std::numbers::sqrt2);
        result.data()[i] = static_cast<float>(std::pow(colours.data()[i], 1 - feature));
    }
    return result;
}

double mean_flip(const RgbImage& image, const RgbImage& reference, const ParallelFor& parallel_for) {
    double sum = 0;
    for (float difference : flip(image, reference, parallel_for))
        sum += static_cast<double>(difference);
    return sum / static_cast<double>(image.size());
}

} // namespace tessera
