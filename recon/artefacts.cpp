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

Rgb in_units(Rgb c, double unit) {
    return Rgb(glm::dvec3(c) * unit);
}

RgbImage in_units(const RgbImage& image, double unit) {
    RgbImage result = image;
    for (Rgb& c : result)
        c = is_finite(in_units(c, unit)) ? in_units(c, unit) : Rgb(0);
    return result;
}

Image<double> luminances(const RgbImage& image) {
    Image<double> result(image.width(), image.height());
    for (std::size_t i = 0; i < image.size(); ++i)
        result.data()[i] = luminance(image.data()[i]);
    return result;
}

/// Means of luminances over the square pieces of an image, over those of the reference.
std::vector<double> pieces_of(const RgbImage& image, const RgbImage& r1, const RgbImage& r2) {
    const std::vector<Piece> pieces = pieces_of(luminances(image), piece_edge);
    const std::vector<Piece> expected1 = pieces_of(luminances(r1), piece_edge);
    const std::vector<Piece> expected2 = pieces_of(luminances(r2), piece_edge);
    std::vector<double> relative;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const double pixels = pieces[i].pixels, expected = (expected1[i].sum + expected2[i].sum) / 2;
        relative.push_back(pieces[i].sum /
                           std::sqrt(expected * expected + relative_mse_epsilon * pixels * pixels));
    }
    return relative;
}

} // namespace

std::size_t worst_count(std::size_t pixels) {
    return std::min(pixels, 16 + pixels / 1000);
}

Artefacts measure_artefacts(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2) {
    const double unit = unit_of(reference1, reference2);
    const RgbImage value = in_units(image, unit), r1 = in_units(reference1, unit), r2 = in_units(reference2, unit);
    Image<double> errors = floor_free_errors(value, r1, r2); // checks the sizes, too
    Artefacts artefacts;
    artefacts.error = mean_of_blocks(errors);
    artefacts.mean = mean_luminance(value);
    artefacts.pieces = pieces_of(value, r1, r2);
    artefacts.bad_pixels = static_cast<std::size_t>(
        std::count_if(image.begin(), image.end(), [unit](Rgb c) { return !is_finite(in_units(c, unit)); }));
    for (double& error : errors)
        error = std::max(0.0, error);
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
    double mean_variance = 0, fourth_power = 0; // the latter a mean
    const Image<double> errors = reference_errors(r1, r2);
    for (std::size_t i = 0; i < r1.size(); ++i) {
        // (n1 - n2)^2 / 4 estimates the variance of (n1 + n2) / 2, and (n1 - n2)^2 / 2 that of n1 and n2.
        mean_variance += std::pow((luminance(r1.data()[i]) - luminance(r2.data()[i])) / 2 / count, 2);
        // E[((n1 - n2)^2 / 2)^2] = 3 s^4 of normal noise.
        fourth_power += std::pow(2 * errors.data()[i], 2) / 3 / count;
    }
    noise.mean_error = std::sqrt(mean_variance);
    // Var(n1 n2) = s^4; and as r^2 is noisy, too, E[n1 n2 / (1 + (n1 + n2) / 2)^2] = 3/2 s^4 + ...
    noise.squared_error_error = std::hypot(std::sqrt(fourth_power / count), 1.5 * fourth_power);
    return noise;
}

} // namespace tessera
