#include "recon/picture/light_spreader.h"

#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace tessera {

double sum_of_sizes(const RgbImage& light, const ParallelFor& parallel_for) {
    return sum_over_pixels(light.width(), light.height(), parallel_for,
                           [&](std::size_t i) { return size_of(light.data()[i]); });
}

namespace {

constexpr float stands_out = 0.1f; // of a pixel's brightness: more is not given to it
constexpr float passes_on = 1e-6f; // of its brightness, that a pixel has which is given nothing

using Channels = std::array<Plane, 3>;

Rgb colour_at(const Channels& channels, std::size_t i) {
    return {channels[0].data()[i], channels[1].data()[i], channels[2].data()[i]};
}

void set_colour(Channels& channels, std::size_t i, Rgb colour) {
    for (std::size_t c = 0; c < channels.size(); ++c)
        channels[c].data()[i] = colour[static_cast<int>(c)];
}

/// S: albedo times light, and a little more. As much more as keeps its quotients with what is spread finite.
Channels spreading_by(const RgbImage& image, const RgbImage& spread, const GuideImages& guides,
                      const ParallelFor& parallel_for) {
    const int width = image.width(), height = image.height();
    Image<float> light(width, height, Unfilled());
    for_pixels(width, height, parallel_for,
               [&](std::size_t i) { light.data()[i] = brightness_of(light_at(image, guides, i)); });
    double sum = sum_over_pixels(width, height, parallel_for, [&](std::size_t i) { return light.data()[i]; });
    sum = std::max(dark * sum, 1e-6 * sum_of_sizes(spread, parallel_for));
    const auto more = static_cast<float>(sum / static_cast<double>(image.size()));
    Channels brightness;
    make_planes(brightness, width, height);
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        set_colour(brightness, i, seen_albedo(guides, i) * (light.data()[i] + more));
    });
    return brightness;
}

/// The most that each pixel is given: a tenth of S, and no more than it has room for. S becomes less where that is
/// less, so that others are given it.
Channels take_limits(const RgbImage& room, Channels& brightness, const ParallelFor& parallel_for) {
    const int width = brightness[0].width(), height = brightness[0].height();
    Channels most;
    make_planes(most, width, height);
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        for (std::size_t c = 0; c < most.size(); ++c) {
            float &m = most[c].data()[i], &s = brightness[c].data()[i];
            m = stands_out * s;
            if (room.empty())
                continue;
            m = std::clamp(room.data()[i][static_cast<int>(c)], 0.0f, m);
            s = std::max(m / stands_out, passes_on * s);
        }
    });
    return most;
}

/// H becomes S K(H / K(S)), with the K of one level.
/// @param ratio  of the same size, anything
void spread_one_level(const Channels& brightness, const PairWeights& weights, int step,
                      const ParallelFor& parallel_for, Channels& light, Channels& ratio) {
    for_kernel_sums(brightness, weights, step, parallel_for, [&](int y, const auto& sums) {
        for (std::size_t c = 0; c < light.size(); ++c)
            for (int x = sums.begin; x < sums.end; ++x)
                ratio[c](x, y) = light[c](x, y) / sums.values[c][x - sums.begin];
    });
    for_kernel_sums(ratio, weights, step, parallel_for, [&](int y, const auto& sums) {
        for (std::size_t c = 0; c < light.size(); ++c)
            for (int x = sums.begin; x < sums.end; ++x)
                light[c](x, y) = brightness[c](x, y) * sums.values[c][x - sums.begin];
    });
}

} // namespace

void spread_to_alike(RgbImage& light, RgbImage& image, const AlikePixels& alike, const GuideImages& guides,
                     const RgbImage& room, const ParallelFor& parallel_for) {
    if (!(sum_of_sizes(light, parallel_for) > 0))
        return;
    const int width = image.width(), height = image.height();
    Channels brightness = spreading_by(image, light, guides, parallel_for);
    const Channels most = take_limits(room, brightness, parallel_for);
    Channels spread, ratio;
    make_planes(spread, width, height);
    make_planes(ratio, width, height);
    for_pixels(width, height, parallel_for, [&](std::size_t i) { set_colour(spread, i, light.data()[i]); });
    for (std::size_t level = 0; level < AlikePixels::steps.size(); ++level)
        spread_one_level(brightness, alike.weights(level), AlikePixels::steps[level], parallel_for, spread, ratio);
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        const Rgb added = colour_at(spread, i);
        const float size = size_of(added), limit = luminance(colour_at(most, i));
        const float share = size > limit ? limit / size : 1;
        image.data()[i] += share * added;
        light.data()[i] = (1 - share) * added;
    });
}

namespace {

/// Of the squares over which light is spread, in pixels.
constexpr int spread_radius = 6;

/// It follows the brightness of the pixels about each: of those that look alike, and in part of all, as what looks
/// unlike may be a few points of many. A pixel's own brightness would make spikes anew where few samples find
/// light at all.
constexpr std::size_t near_levels = 2; // of AlikePixels: within 8 pixels
constexpr int near_radius = 1;
constexpr float of_all = 0.3f;

/// A row with what is beyond its borders: the picture goes on as in a mirror.
template <class Pixel>
void mirror_row(const Pixel* row, int width, int reach, Pixel* out) {
    for (int i = -reach; i < width + reach; ++i)
        out[i + reach] = row[i < 0 ? -1 - i : i >= width ? 2 * width - 1 - i : i];
}

int mirrored(int i, int count) {
    return i < 0 ? -1 - i : i >= count ? 2 * count - 1 - i : i;
}

float* numbers_of(float* pixels) {
    return pixels;
}
float* numbers_of(Rgb* pixels) {
    return &pixels->x;
}

/// Three means over squares, which is about a Gaussian. Every pixel gets of each other as much as it gives.
template <class Pixel>
void blur(Image<Pixel>& image, int radius, const ParallelFor& parallel_for) {
    constexpr std::size_t channels = sizeof(Pixel) / sizeof(float);
    const int width = image.width(), height = image.height();
    const int r_x = std::min(radius, width - 1), r_y = std::min(radius, height - 1);
    const float share = 1 / static_cast<float>((2 * r_x + 1) * (2 * r_y + 1));
    const std::size_t row_numbers = channels * static_cast<std::size_t>(width);
    Image<Pixel> other(width, height, Unfilled());
    for (int round = 0; round < 3; ++round) {
        parallel_for(height, [&](int y) {
            std::vector<Pixel> padded(static_cast<std::size_t>(width + 2 * r_x));
            mirror_row(image.row(y), width, r_x, padded.data());
            sum_windows(numbers_of(padded.data()), row_numbers, 2 * r_x + 1, channels, numbers_of(other.row(y)));
        });
        const auto row = [&](int y) { return numbers_of(other.row(mirrored(y, height))); };
        for_sums_of_rows(row_numbers, height, r_y, row, parallel_for,
                         [&](int y, std::size_t begin, std::size_t end, const float* sums) {
                             float* means = numbers_of(image.row(y));
                             for (std::size_t i = begin; i < end; ++i)
                                 means[i] = share * sums[i - begin];
                         });
    }
}

/// The brightness about each pixel; 0 where it is black.
Plane brightness_about(const RgbImage& image, const AlikePixels& alike, const Image<std::uint8_t>& black,
                       const ParallelFor& parallel_for) {
    const int width = image.width(), height = image.height();
    const double sum = sum_over_pixels(width, height, parallel_for,
                                       [&](std::size_t i) { return std::max(0.0f, luminance(image.data()[i])); });
    // Where a whole neighbourhood is black, light is spread evenly; as in a picture that is black.
    const auto least = sum > 0 ? static_cast<float>(1e-4 * sum / static_cast<double>(image.size())) : 1.0f;
    Plane brightness(width, height, Unfilled()), plain(width, height, Unfilled());
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        brightness.data()[i] = plain.data()[i] = std::max(luminance(image.data()[i]), 0.0f) + least;
    });
    blur(plain, near_radius, parallel_for);
    alike.take_means(near_levels, brightness, parallel_for);
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        const float both = (1 - of_all) * brightness.data()[i] + of_all * plain.data()[i];
        brightness.data()[i] = black.empty() || !black.data()[i] ? both : 0;
    });
    return brightness;
}

} // namespace

LitSurroundings lit_surroundings(const RgbImage& shown, const AlikePixels& alike, const Image<std::uint8_t>& black,
                                 const ParallelFor& parallel_for) {
    Plane brightness = brightness_about(shown, alike, black, parallel_for);
    Plane around = copy_of(brightness, parallel_for);
    blur(around, spread_radius, parallel_for);
    return {std::move(brightness), std::move(around)};
}

void spread_around(const RgbImage& light, const LitSurroundings& surroundings, RgbImage& image,
                   const ParallelFor& parallel_for) {
    const double sum = sum_of_sizes(light, parallel_for);
    if (!(sum > 0))
        return;
    const auto least = static_cast<float>(1e-30 * sum); // so that quotients are finite
    const Plane &brightness = surroundings.brightness, &around = surroundings.around;
    const int width = image.width(), height = image.height();
    RgbImage ratio(width, height, Unfilled());
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        ratio.data()[i] = around.data()[i] > least ? light.data()[i] / around.data()[i] : Rgb(0);
    });
    blur(ratio, spread_radius, parallel_for);
    for_pixels(width, height, parallel_for,
               [&](std::size_t i) { image.data()[i] += brightness.data()[i] * ratio.data()[i]; });
}

} // namespace tessera
