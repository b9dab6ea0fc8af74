#include "app/experiment/artefacts.h"

#include "recon/metrics/metrics.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <stdexcept>

#include <glm/ext/vector_double3.hpp>

namespace tessera {

namespace {

// Pixels. Larger than the default tile and a gradient's pixel pair, within which errors correlate.
constexpr int piece_edge = 8;

double mean_luminance(const RgbImage& image) {
    double sum = 0;
    for (Rgb c : image)
        sum += luminance(c);
    return sum / static_cast<double>(image.size());
}

/// Returns the factor that converts radiances to the units of Artefacts.
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

/// Returns the mean luminances of the square pieces of an image, relative to the reference.
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

double tone_mapped(float x) {
    return x > 0 ? static_cast<double>(x) / (1 + static_cast<double>(x)) : 0;
}

/// Returns the mean over pixels and channels. As in relMSE, two references cancel their own noise.
double tone_mapped_error(const RgbImage& image, const RgbImage& r1, const RgbImage& r2) {
    double sum = 0;
    for (std::size_t i = 0; i < image.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double v = tone_mapped(image.data()[i][c]);
            sum += (v - tone_mapped(r1.data()[i][c])) * (v - tone_mapped(r2.data()[i][c])) / 3;
        }
    return sum / static_cast<double>(image.size());
}

double tenfold_share(const RgbImage& image, const RgbImage& r1, const RgbImage& r2) {
    static constexpr double least = 0.01, fold = 10; // least: smallest luminance, in units of the mean
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const auto luminance_of = [i](const RgbImage& of) {
            return std::max(static_cast<double>(luminance(of.data()[i])), least);
        };
        const double v = luminance_of(image), a = luminance_of(r1), b = luminance_of(r2);
        count += v > fold * std::max(a, b) || fold * v < std::min(a, b);
    }
    return static_cast<double>(count) / static_cast<double>(image.size());
}

} // namespace

std::size_t worst_count(std::size_t pixels) {
    return std::min(pixels, 16 + pixels / 1000);
}

Artefacts measure_artefacts(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2) {
    const double unit = unit_of(reference1, reference2);
    const RgbImage value = in_units(image, unit), r1 = in_units(reference1, unit), r2 = in_units(reference2, unit);
    Image<double> errors = floor_free_errors(value, r1, r2); // also checks the sizes
    Artefacts artefacts;
    artefacts.error = mean_of_pieces(errors);
    artefacts.mean = mean_luminance(value);
    artefacts.pieces = pieces_of(value, r1, r2);
    artefacts.tone_mapped = tone_mapped_error(value, r1, r2);
    artefacts.tenfold = tenfold_share(value, r1, r2);
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
    double mean_variance = 0, fourth_power = 0; // fourth_power: mean of s^4
    const Image<double> errors = reference_errors(r1, r2);
    for (std::size_t i = 0; i < r1.size(); ++i) {
        // n1 and n2 are the noise of r1 and r2. (n1 - n2)^2 / 4 estimates the variance of their mean, and
        // (n1 - n2)^2 / 2 that of each.
        mean_variance += std::pow((luminance(r1.data()[i]) - luminance(r2.data()[i])) / 2 / count, 2);
        // Normal noise has E[((n1 - n2)^2 / 2)^2] = 3 s^4.
        fourth_power += std::pow(2 * errors.data()[i], 2) / 3 / count;
    }
    noise.mean_error = std::sqrt(mean_variance);
    // Var(n1 n2) = s^4. As r^2 is noisy too, E[n1 n2 / (1 + (n1 + n2) / 2)^2] = 3/2 s^4 + higher powers.
    noise.squared_error_error = std::hypot(std::sqrt(fourth_power / count), 1.5 * fourth_power);
    return noise;
}

namespace {

using Signal = std::vector<double>;

/// Returns |sum of s(n) exp(-2 pi i n j / length)|^2 of the signal minus its mean.
double power(const Signal& signal, std::size_t j) {
    const auto length = static_cast<double>(signal.size());
    double mean = 0;
    for (double s : signal)
        mean += s / length;
    const std::complex<double> turn = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(j) / length);
    std::complex<double> sum = 0, phase = 1;
    for (double s : signal) {
        sum += (s - mean) * phase;
        phase *= turn;
    }
    return std::norm(sum);
}

/// Power at the multiples of the frequency 1 / tile (`at`), and at the frequencies around them (`about`).
struct Comb {
    double at = 0, about = 0;
    int at_count = 0, about_count = 0;

    void operator+=(const Comb& other) {
        at += other.at;
        about += other.about;
        at_count += other.at_count;
        about_count += other.about_count;
    }
    double ratio() const { return about > 0 ? at / at_count / (about / about_count) : 1; }
};

/// Sums the power of a signal. Its length must be a multiple of `tile`, so that each multiple of 1 / tile is a
/// discrete frequency.
Comb comb_of(const Signal& signal, int tile) {
    const std::size_t tiles = signal.size() / static_cast<std::size_t>(tile);
    const std::size_t reach = (tiles - 1) / 2;                    // half the distance to the next multiple
    const std::size_t step = std::max<std::size_t>(1, reach / 6); // about six frequencies on each side are enough
    Comb comb;
    for (std::size_t k = 1; 2 * k <= static_cast<std::size_t>(tile); ++k) {
        comb.at += power(signal, k * tiles);
        ++comb.at_count;
        for (std::size_t d = step; d <= reach; d += step) {
            comb.about += power(signal, k * tiles - d) + power(signal, k * tiles + d);
            comb.about_count += 2;
        }
    }
    return comb;
}

Image<double> relative_errors(const RgbImage& image, const RgbImage& reference, int tile) {
    const int width = image.width() / tile * tile, height = image.height() / tile * tile;
    Image<double> errors(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double value = luminance(image(x, y)), truth = luminance(reference(x, y));
            const double error = (value - truth) / std::sqrt(truth * truth + relative_mse_epsilon);
            errors(x, y) = std::isfinite(error) ? std::clamp(error, -1.0, 1.0) : 1.0;
        }
    return errors;
}

Image<double> transposed(const Image<double>& image) {
    Image<double> result(image.height(), image.width());
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            result(y, x) = image(x, y);
    return result;
}

Signal row_of(const Image<double>& image, int y) {
    return {image.row(y), image.row(y) + image.width()};
}

/// Returns, for each column x, the mean squared difference between columns x - 1 and x. Column 0 has no left
/// neighbour and gets the value of the same position in the second tile.
Signal mean_steps(const Image<double>& errors, int tile) {
    Signal steps(static_cast<std::size_t>(errors.width()));
    for (int x = 1; x < errors.width(); ++x)
        for (int y = 0; y < errors.height(); ++y)
            steps[static_cast<std::size_t>(x)] += std::pow(errors(x, y) - errors(x - 1, y), 2) / errors.height();
    steps[0] = steps[static_cast<std::size_t>(tile)];
    return steps;
}

/// Returns the largest mean squared difference by position within the tile, over the mean at the other positions.
double largest_ratio(const Signal& steps, int tile) {
    Signal by_place(static_cast<std::size_t>(tile));
    for (std::size_t x = 0; x < steps.size(); ++x)
        by_place[x % by_place.size()] += steps[x];
    const double largest = *std::max_element(by_place.begin(), by_place.end());
    double sum = 0;
    for (double step : by_place)
        sum += step;
    return largest > 0 ? largest * (tile - 1) / (sum - largest) : 1;
}

} // namespace

TileSpectrum measure_tile_spectrum(const RgbImage& image, const RgbImage& reference, int tile) {
    if (image.width() != reference.width() || image.height() != reference.height())
        throw std::invalid_argument("images to compare differ in size");
    if (tile < 2 || std::min(image.width(), image.height()) < 4 * tile)
        throw std::invalid_argument(
            "a tile spectrum needs tiles of at least 2 pixels, and 4 tiles along each edge");
    const Image<double> errors = relative_errors(image, reference, tile);
    TileSpectrum spectrum;
    Comb error;
    for (const Image<double>& along : {errors, transposed(errors)}) {
        for (int y = 0; y < along.height(); ++y)
            error += comb_of(row_of(along, y), tile);
        const Signal steps = mean_steps(along, tile);
        spectrum.edges += comb_of(steps, tile).ratio() / 2;
        spectrum.edge_ratio += largest_ratio(steps, tile) / 2;
    }
    spectrum.error = error.ratio();
    return spectrum;
}

} // namespace tessera
