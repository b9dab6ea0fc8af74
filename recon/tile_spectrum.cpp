#include "recon/tile_spectrum.h"

#include "recon/metrics.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace tessera {

namespace {

using Signal = std::vector<double>;

/// |sum of s(n) exp(-2 pi i n j / length)|^2 of the signal without its mean.
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

/// Power at the multiples of 1 / tile, and at the frequencies about them.
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

/// The signal must be a whole number of tiles long, so that each multiple is one of its frequencies.
Comb comb_of(const Signal& signal, int tile) {
    const std::size_t tiles = signal.size() / static_cast<std::size_t>(tile);
    const std::size_t reach = (tiles - 1) / 2;                    // to half-way between two multiples
    const std::size_t step = std::max<std::size_t>(1, reach / 6); // some of these tell enough
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

/// Of each column x, the mean squared step from x - 1 to x. There is none to the first: it counts as that to the
/// same place of the second tile.
Signal mean_steps(const Image<double>& errors, int tile) {
    Signal steps(static_cast<std::size_t>(errors.width()));
    for (int x = 1; x < errors.width(); ++x)
        for (int y = 0; y < errors.height(); ++y)
            steps[static_cast<std::size_t>(x)] += std::pow(errors(x, y) - errors(x - 1, y), 2) / errors.height();
    steps[0] = steps[static_cast<std::size_t>(tile)];
    return steps;
}

/// Mean step by place in the tile: the largest over the mean of the others.
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
        throw std::invalid_argument("a spectrum of tiles takes tiles of 2 pixels and more, and 4 of them");
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
