#include "recon/picture/light_spreader.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace tessera {

namespace {

constexpr float dark = 0.2f;       // of the mean light, that any pixel counts as brighter by
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

/// |v|: luminance, whatever the signs.
float size_of(Rgb v) {
    return luminance(glm::abs(v));
}

double sum_of_sizes(const RgbImage& image) {
    double sum = 0;
    for (Rgb c : image)
        sum += static_cast<double>(size_of(c));
    return sum;
}

/// Calls visit(i) for all pixels.
template <class Visit>
void for_pixels(const RgbImage& image, const ParallelFor& parallel_for, Visit&& visit) {
    const auto width = static_cast<std::size_t>(image.width());
    parallel_for(image.height(), [&](int y) {
        for (std::size_t i = static_cast<std::size_t>(y) * width, end = i + width; i < end; ++i)
            visit(i);
    });
}

/// The mean of the channels of the light at each pixel, radiance over albedo.
Image<float> light_of(const RgbImage& image, const GuideImages& guides, const ParallelFor& parallel_for) {
    Image<float> light(image.width(), image.height());
    for_pixels(image, parallel_for, [&](std::size_t i) {
        const Rgb c = image.data()[i] / seen_albedo(guides, i);
        light.data()[i] = std::max((c.r + c.g + c.b) / 3, 0.0f);
    });
    return light;
}

/// S: albedo times light, and a little more. As much more as keeps its quotients with what is spread finite.
Channels brightness_of(const RgbImage& image, const RgbImage& spread, const GuideImages& guides,
                       const ParallelFor& parallel_for) {
    const Image<float> light = light_of(image, guides, parallel_for);
    double sum = 0;
    for (float l : light)
        sum += static_cast<double>(l);
    sum = std::max(dark * sum, 1e-6 * sum_of_sizes(spread));
    const auto more = static_cast<float>(sum / static_cast<double>(image.size()));
    Channels brightness;
    make_planes(brightness, image.width(), image.height());
    for_pixels(image, parallel_for, [&](std::size_t i) {
        set_colour(brightness, i, seen_albedo(guides, i) * (light.data()[i] + more));
    });
    return brightness;
}

/// The most that each pixel is given: a tenth of S, and no more than it has room for. S becomes less where that is
/// less, so that others are given it.
Channels take_limits(const RgbImage& room, Channels& brightness) {
    Channels most = brightness;
    for (std::size_t c = 0; c < most.size(); ++c)
        for (std::size_t i = 0; i < most[c].size(); ++i) {
            float &m = most[c].data()[i], &s = brightness[c].data()[i];
            m *= stands_out;
            if (room.empty())
                continue;
            m = std::clamp(room.data()[i][static_cast<int>(c)], 0.0f, m);
            s = std::max(m / stands_out, passes_on * s);
        }
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

AlikePixels::AlikePixels(glm::ivec2 size, const GuideImages& guides, const ParallelFor& parallel_for) {
    const GuidePlanes planes = planes_of(guides, parallel_for);
    for (std::size_t level = 0; level < steps.size(); ++level) {
        make_planes(weights_[level], size.x, size.y);
        write_pair_weights(planes, {}, steps[level], parallel_for, weights_[level]);
    }
}

void AlikePixels::take_means(std::size_t levels, Plane& values, const ParallelFor& parallel_for) const {
    std::array<Plane, 1> from{std::move(values)}, to{Plane(from[0].width(), from[0].height())};
    for (std::size_t level = 0; level < levels; ++level) {
        for_kernel_sums(from, weights_[level], steps[level], parallel_for, [&](int y, const auto& sums) {
            for (int x = sums.begin; x < sums.end; ++x)
                to[0](x, y) = sums.values[0][x - sums.begin] / sums.weights[x - sums.begin];
        });
        std::swap(from, to);
    }
    values = std::move(from[0]);
}

void spread_to_alike(RgbImage& light, RgbImage& image, const AlikePixels& alike, const GuideImages& guides,
                     const RgbImage& room, const ParallelFor& parallel_for) {
    if (!(sum_of_sizes(light) > 0))
        return;
    Channels brightness = brightness_of(image, light, guides, parallel_for);
    const Channels most = take_limits(room, brightness);
    Channels spread, ratio;
    make_planes(spread, image.width(), image.height());
    make_planes(ratio, image.width(), image.height());
    for_pixels(image, parallel_for, [&](std::size_t i) { set_colour(spread, i, light.data()[i]); });
    for (std::size_t level = 0; level < AlikePixels::steps.size(); ++level)
        spread_one_level(brightness, alike.weights(level), AlikePixels::steps[level], parallel_for, spread, ratio);
    for_pixels(image, parallel_for, [&](std::size_t i) {
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

/// Three means over squares, which is about a Gaussian. Every pixel gets of each other as much as it gives. Sums
/// are made anew for each pixel: running ones would leave the rounding of a bright pixel behind it.
template <class Pixel>
void blur(Image<Pixel>& image, int radius, const ParallelFor& parallel_for) {
    const int width = image.width(), height = image.height();
    const int r_x = std::min(radius, width - 1), r_y = std::min(radius, height - 1);
    Image<Pixel> other(width, height);
    for (int round = 0; round < 3; ++round) {
        parallel_for(height, [&](int y) {
            std::vector<Pixel> padded(static_cast<std::size_t>(width + 2 * r_x));
            mirror_row(image.row(y), width, r_x, padded.data());
            Pixel* sums = other.row(y);
            std::fill_n(sums, width, Pixel(0));
            for (int i = 0; i <= 2 * r_x; ++i)
                for (int x = 0; x < width; ++x)
                    sums[x] += padded[static_cast<std::size_t>(x + i)];
            for (int x = 0; x < width; ++x)
                sums[x] /= static_cast<float>(2 * r_x + 1);
        });
        parallel_for(height, [&](int y) {
            Pixel* sums = image.row(y);
            std::fill_n(sums, width, Pixel(0));
            for (int j = y - r_y; j <= y + r_y; ++j) {
                const Pixel* row = other.row(mirrored(j, height));
                for (int x = 0; x < width; ++x)
                    sums[x] += row[x];
            }
            for (int x = 0; x < width; ++x)
                sums[x] /= static_cast<float>(2 * r_y + 1);
        });
    }
}

} // namespace

LightSpreader::LightSpreader(const RgbImage& image, const AlikePixels& alike, const Image<std::uint8_t>& black,
                             const ParallelFor& parallel_for)
    : brightness_(image.width(), image.height()) {
    double sum = 0;
    for (Rgb c : image)
        sum += std::max(0.0, static_cast<double>(luminance(c)));
    // Where a whole neighbourhood is black, light is spread evenly; as in a picture that is black.
    const auto least = sum > 0 ? static_cast<float>(1e-4 * sum / static_cast<double>(image.size())) : 1.0f;
    for (std::size_t i = 0; i < image.size(); ++i)
        brightness_.data()[i] = std::max(luminance(image.data()[i]), 0.0f) + least;
    Plane plain = brightness_;
    blur(plain, near_radius, parallel_for);
    alike.take_means(near_levels, brightness_, parallel_for);
    for (std::size_t i = 0; i < plain.size(); ++i)
        brightness_.data()[i] = (1 - of_all) * brightness_.data()[i] + of_all * plain.data()[i];
    for (std::size_t i = 0; i < black.size(); ++i)
        brightness_.data()[i] = black.data()[i] ? 0 : brightness_.data()[i];
    around_ = brightness_;
    blur(around_, spread_radius, parallel_for);
}

/// With brightness s, what a pixel q has goes to p by s(p) blur(p, q) / (sum over the p' of s(p') blur(p', q)).
void LightSpreader::spread(const RgbImage& light, RgbImage& image, const ParallelFor& parallel_for) const {
    const double sum = sum_of_sizes(light);
    if (!(sum > 0))
        return;
    const auto least = static_cast<float>(1e-30 * sum); // so that quotients are finite
    RgbImage ratio = light;
    for (std::size_t i = 0; i < image.size(); ++i)
        ratio.data()[i] = around_.data()[i] > least ? ratio.data()[i] / around_.data()[i] : Rgb(0);
    blur(ratio, spread_radius, parallel_for);
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] += brightness_.data()[i] * ratio.data()[i];
}

} // namespace tessera
