#include "recon/artefacts.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <glm/ext/vector_double3.hpp>

namespace tessera {

namespace {

constexpr int piece_edge = 8; // pixels: larger than the tiles and dipoles that make neighbours err alike

double mean_luminance(const RgbImage& image) {
    double sum = 0;
    for (Rgb c : image)
        sum += luminance(c);
    return sum / static_cast<double>(image.size());
}

/// By which radiances are multiplied.
double unit_of(const RgbImage& reference1, const RgbImage& reference2) {
    const double mean = (mean_luminance(reference1) + mean_luminance(reference2)) / 2;
    return mean > 0 ? 1 / mean : 1;
}

RgbImage in_units(const RgbImage& image, double unit) {
    RgbImage result = image;
    for (Rgb& c : result)
        c = is_finite(c) ? Rgb(glm::dvec3(c) * unit) : Rgb(0);
    return result;
}

/// Means of luminances over the square pieces of an image, over those of the reference.
std::vector<double> pieces_of(const RgbImage& image, const RgbImage& r1, const RgbImage& r2) {
    const int columns = (image.width() + piece_edge - 1) / piece_edge;
    const int rows = (image.height() + piece_edge - 1) / piece_edge;
    std::vector<double> sums(static_cast<std::size_t>(columns) * rows), expected(sums.size()), counts(sums.size());
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const std::size_t piece = static_cast<std::size_t>(y / piece_edge) * columns + x / piece_edge;
            sums[piece] += luminance(image(x, y));
            expected[piece] += (luminance(r1(x, y)) + luminance(r2(x, y))) / 2;
            counts[piece] += 1;
        }
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] /= std::sqrt(expected[i] * expected[i] + relative_mse_epsilon * counts[i] * counts[i]);
    return sums;
}

/// Of the mean over the three channels.
double squared_error(glm::dvec3 value, glm::dvec3 r1, glm::dvec3 r2) {
    const glm::dvec3 r = (r1 + r2) / 2.0;
    const glm::dvec3 e = (value - r1) * (value - r2) / (r * r + relative_mse_epsilon);
    return (e.r + e.g + e.b) / 3;
}

} // namespace

std::size_t worst_count(std::size_t pixels) {
    return std::min(pixels, 16 + pixels / 1000);
}

Artefacts measure_artefacts(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2) {
    const double unit = unit_of(reference1, reference2);
    const RgbImage value = in_units(image, unit), r1 = in_units(reference1, unit), r2 = in_units(reference2, unit);
    Artefacts artefacts;
    artefacts.error = measure_floor_free_error(value, r1, r2); // checks the sizes, too
    artefacts.mean = mean_luminance(value);
    artefacts.pieces = pieces_of(value, r1, r2);
    std::vector<double> errors(image.size());
    for (std::size_t i = 0; i < image.size(); ++i) {
        errors[i] = std::max(0.0, squared_error(value.data()[i], r1.data()[i], r2.data()[i]));
        artefacts.bad_pixels += !is_finite(image.data()[i]);
    }
    const int worst = static_cast<int>(std::max_element(errors.begin(), errors.end()) - errors.begin());
    artefacts.worst_pixel = {worst % image.width(), worst / image.width()};
    artefacts.worst.resize(worst_count(errors.size()));
    std::partial_sort_copy(errors.begin(), errors.end(), artefacts.worst.begin(), artefacts.worst.end(),
                           std::greater<>());
    return artefacts;
}

ReferenceNoise measure_reference_noise(const RgbImage& reference1, const RgbImage& reference2) {
    const double unit = unit_of(reference1, reference2);
    const RgbImage r1 = in_units(reference1, unit), r2 = in_units(reference2, unit);
    ReferenceNoise noise;
    noise.pieces[0] = pieces_of(r1, r1, r2);
    noise.pieces[1] = pieces_of(r2, r1, r2);
    noise.is_black = std::all_of(r1.begin(), r1.end(), is_black) && std::all_of(r2.begin(), r2.end(), is_black);
    const auto count = static_cast<double>(r1.size());
    double mean_variance = 0, fourth_powers = 0;
    for (std::size_t i = 0; i < r1.size(); ++i) {
        const glm::dvec3 a = r1.data()[i], b = r2.data()[i];
        // (n1 - n2)^2 / 4 estimates the variance of (n1 + n2) / 2, and (n1 - n2)^2 / 2 that of n1 and n2.
        mean_variance += std::pow((luminance(r1.data()[i]) - luminance(r2.data()[i])) / 2 / count, 2);
        // Var(n1 n2) = s^4, and E[((n1 - n2)^2 / 2)^2] = 3 s^4 of normal noise.
        const double variance = squared_error(a, b, b) / 2 / count;
        fourth_powers += variance * variance / 3;
    }
    noise.mean_error = std::sqrt(mean_variance);
    noise.squared_error_error = std::sqrt(fourth_powers);
    return noise;
}

} // namespace tessera
