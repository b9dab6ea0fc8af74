#include "recon/guided/redistribution.h"

#include "recon/local_brightness.h"
#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace tessera {

double sum_of_sizes(const RgbImage& radiance, const ParallelFor& parallel_for) {
    return sum_over_pixels(radiance.width(), radiance.height(), parallel_for,
                           [&](std::size_t i) { return size_of(radiance.data()[i]); });
}

namespace {

using Channels = std::array<Plane, 3>;

/// Limits a brightness to 1e20, so that sums and products stay finite. NaN becomes 1e20.
float limited(float brightness) {
    constexpr float largest = 1e20f;
    return brightness < largest ? brightness : largest;
}

Rgb colour_at(const Channels& channels, std::size_t i) {
    return {channels[0].data()[i], channels[1].data()[i], channels[2].data()[i]};
}

void set_colour(Channels& channels, std::size_t i, Rgb colour) {
    for (int c = 0; c < 3; ++c)
        channels[c].data()[i] = colour[c];
}

/// Returns a local mean brightness of at least 1e-6 of the local mean energy, so that quotients of the two stay
/// finite in black regions.
Image<float> raised_to_energy(const Image<float>& local_light, const RgbImage& energy, int radius,
                              const ParallelFor& parallel_for) {
    Image<float> local(energy.width(), energy.height(), Unfilled());
    for_pixels(energy.width(), energy.height(), parallel_for,
               [&](std::size_t i) { local.data()[i] = size_of(energy.data()[i]); });
    local = local_mean_brightness(std::move(local), radius, parallel_for);
    for_pixels(energy.width(), energy.height(), parallel_for,
               [&](std::size_t i) { local.data()[i] = std::max(1e-6f * local.data()[i], local_light.data()[i]); });
    return local;
}

/// Returns S of reconstruction (60).
Channels followed_brightness(const RgbImage& picture, const FeatureImages& features, const Image<float>& local,
                             const GuidedParameters& parameters, const ParallelFor& parallel_for) {
    Channels brightness;
    make_planes(brightness, picture.width(), picture.height());
    for_pixels(picture.width(), picture.height(), parallel_for, [&](std::size_t i) {
        const Rgb albedo = feature_albedo(features, i, parameters.least_albedo);
        const float light = limited(brightness_of(picture.data()[i] / albedo));
        set_colour(brightness, i, albedo * (light + parameters.dark * local.data()[i]));
    });
    return brightness;
}

/// Replaces H by S K(H / K(S)), reconstruction (59), with the K of one level.
/// @param ratio  scratch planes, any content
void spread_one_level(const Channels& brightness, const PairWeights& weights, int step,
                      const ParallelFor& parallel_for, Channels& energy, Channels& ratio) {
    for_kernel_sums(brightness, weights, step, parallel_for, [&](int y, const auto& sums) {
        for (std::size_t c = 0; c < energy.size(); ++c)
            for (int x = sums.begin; x < sums.end; ++x)
                ratio[c](x, y) = energy[c](x, y) / sums.values[c][x - sums.begin];
    });
    for_kernel_sums(ratio, weights, step, parallel_for, [&](int y, const auto& sums) {
        for (std::size_t c = 0; c < energy.size(); ++c)
            for (int x = sums.begin; x < sums.end; ++x)
                energy[c](x, y) = brightness[c](x, y) * sums.values[c][x - sums.begin];
    });
}

/// Adds energy to pixels with similar features, and leaves in `energy` what exceeds largest_addition of S.
void spread_to_similar(const Channels& brightness, const FeatureKernels& kernels,
                       const GuidedParameters& parameters, const ParallelFor& parallel_for, RgbImage& energy,
                       RgbImage& picture) {
    const int width = picture.width(), height = picture.height();
    Channels spread, ratio;
    make_planes(spread, width, height);
    make_planes(ratio, width, height);
    for_pixels(width, height, parallel_for, [&](std::size_t i) { set_colour(spread, i, energy.data()[i]); });
    for (std::size_t level = 0; level < FeatureKernels::steps.size(); ++level)
        spread_one_level(brightness, kernels.weights(level), FeatureKernels::steps[level], parallel_for, spread,
                         ratio);
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        const Rgb added = colour_at(spread, i);
        const float size = size_of(added),
                    limit = parameters.largest_addition * luminance(colour_at(brightness, i));
        const float fraction = size > limit ? limit / size : 1;
        picture.data()[i] += fraction * added;
        energy.data()[i] = (1 - fraction) * added;
    });
}

/// Writes a row that is extended by `reach` mirrored pixels at both ends.
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

/// Takes the mean over squares three times, which is close to a Gaussian. The kernel is symmetric.
template <class Pixel>
void blur(Image<Pixel>& image, int radius, const ParallelFor& parallel_for) {
    constexpr std::size_t channels = sizeof(Pixel) / sizeof(float);
    const int width = image.width(), height = image.height();
    const int r_x = std::min(radius, width - 1), r_y = std::min(radius, height - 1);
    const float inverse_area = 1 / static_cast<float>((2 * r_x + 1) * (2 * r_y + 1));
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
                                 means[i] = inverse_area * sums[i - begin];
                         });
    }
}

/// Returns the mean brightness of the pixels similar to each, and its blur.
NearbyBrightness nearby_brightness(const RgbImage& picture, const FeatureKernels& kernels,
                                   const Image<float>& local, const GuidedParameters& parameters,
                                   const ParallelFor& parallel_for) {
    NearbyBrightness result{Plane(picture.width(), picture.height(), Unfilled()), {}};
    for_pixels(picture.width(), picture.height(), parallel_for, [&](std::size_t i) {
        result.brightness.data()[i] =
            limited(std::max(luminance(picture.data()[i]), 0.0f)) + parameters.least_local * local.data()[i];
    });
    kernels.take_means(parameters.near_levels, result.brightness, parallel_for);
    result.around = copy_of(result.brightness, parallel_for);
    blur(result.around, parameters.around_radius, parallel_for);
    return result;
}

} // namespace

void spread_around(const RgbImage& energy, const NearbyBrightness& nearby, const GuidedParameters& parameters,
                   const ParallelFor& parallel_for, RgbImage& picture) {
    const int width = picture.width(), height = picture.height();
    RgbImage ratio(width, height, Unfilled());
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        const float around = nearby.around.data()[i];
        ratio.data()[i] = around > 0 ? energy.data()[i] / around : Rgb(0);
    });
    blur(ratio, parameters.around_radius, parallel_for);
    for_pixels(width, height, parallel_for,
               [&](std::size_t i) { picture.data()[i] += nearby.brightness.data()[i] * ratio.data()[i]; });
}

NearbyBrightness redistribute(RgbImage energy, const FeatureKernels& kernels, const FeatureImages& features,
                              const Image<float>& local_light, const GuidedParameters& parameters,
                              const ParallelFor& parallel_for, RgbImage& picture) {
    if (!(sum_of_sizes(energy, parallel_for) > 0))
        return {};
    const Image<float> local = raised_to_energy(local_light, energy, parameters.local_radius, parallel_for);
    spread_to_similar(followed_brightness(picture, features, local, parameters, parallel_for), kernels, parameters,
                      parallel_for, energy, picture);
    NearbyBrightness nearby = nearby_brightness(picture, kernels, local, parameters, parallel_for);
    spread_around(energy, nearby, parameters, parallel_for, picture);
    return nearby;
}

} // namespace tessera
