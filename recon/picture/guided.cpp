#include "recon/picture/guided.h"

#include "recon/picture/guide_kernel.h"
#include "recon/picture/guide_regression.h"
#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include <glm/common.hpp>

namespace tessera {

namespace {

// Tried on Veach, Ajar, Country Kitchen and Bathroom at 5 and 20 CPU seconds: none of these numbers matters by
// more than a few percent when it is halved or doubled.
constexpr int levels = 4; // of AlikePixels: pixels within 80
static_assert(levels <= AlikePixels::steps.size());
constexpr int noise_radius = 6; // of the squares that tell noise,
constexpr int trust_radius = 6; // and how far a difference is more than that; wider by the level's step
// Of the regression, which is of 5x5 pixels:
constexpr int weight_radius = 2; // of the brightness that errors are held against,
constexpr int fit_radius = 3;    // and of the squares that tell how far a difference is more than noise

/// Three channels of a picture and three of its noise, each for itself.
using Planes = RegressedPlanes;

/// Planes that are used at every level: memory that is new each time costs a quarter of the smoothing.
struct Scratch {
    Planes coarser;
    StraightWeights weights;
    Plane brightness, noise, sizes, rows;
};

Scratch scratch_of(int width, int height) {
    Scratch scratch;
    make_planes(scratch.coarser, width, height);
    make_planes(scratch.weights, width, height);
    for (Plane* plane : {&scratch.brightness, &scratch.noise, &scratch.sizes, &scratch.rows})
        *plane = Plane(width, height, Unfilled());
    return scratch;
}

/// The light: radiance over what is seen takes of it.
Planes light_of(const NoisyPicture& picture, const GuideImages& guides, const ParallelFor& parallel_for) {
    const int width = picture.image.width(), height = picture.image.height();
    Planes planes;
    make_planes(planes, width, height);
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        const Rgb light[] = {light_at(picture.image, guides, i), light_at(picture.noise, guides, i)};
        for (std::size_t c = 0; c < planes.size(); ++c)
            planes[c].data()[i] = light[c / 3][static_cast<int>(c % 3)];
    });
    return planes;
}

/// The mean of the channels of a picture, or of its noise, at pixel i.
float mean_of(const Planes& planes, std::size_t first, std::size_t i) {
    return (planes[first].data()[i] + planes[first + 1].data()[i] + planes[first + 2].data()[i]) / 3;
}

/// The brightness of pixel i, and a little of the picture's.
float brightness_at(const Planes& planes, float least, std::size_t i) {
    return std::max(mean_of(planes, 0, i), 0.0f) + least;
}

/// The next level of what the last one has left, to scratch.coarser.
void write_next_level(const Planes& from, const AlikePixels& alike, float least, std::size_t level,
                      const ParallelFor& parallel_for, Scratch& scratch) {
    const int step = AlikePixels::steps[level];
    Plane &brightness = scratch.brightness, &noise = scratch.noise;
    const int width = noise.width();
    for_pixels(noise.width(), noise.height(), parallel_for, [&](std::size_t i) {
        const float bright = brightness_at(from, least, i);
        noise.data()[i] = std::abs(mean_of(from, 3, i)) / bright;
        brightness.data()[i] = std::log(bright);
    });
    take_wide_means(noise, noise_radius + step, scratch.rows, parallel_for);
    parallel_for(noise.height(), [&](int y) {
        constexpr float of_gaussian =
            std::numbers::pi_v<float> / 2; // variance over the mean absolute value's square
        for (int x = 0; x < width; ++x)
            noise(x, y) *= of_gaussian * noise(x, y);
    });
    write_noisy_weights(alike.weights(level), brightness, noise, step, parallel_for, scratch.rows,
                        scratch.weights);
    write_kernel_means(from, scratch.weights, step, parallel_for, scratch.coarser);
}

/// The roots of how large differences are beside the coarser picture's brightness, of the picture and of its
/// noise.
void write_root_sizes(const Planes& finer, const Planes& coarser, float least, const ParallelFor& parallel_for,
                      Plane& sizes, Plane& noise) {
    const int width = sizes.width();
    parallel_for(sizes.height(), [&](int y) {
        for (int x = 0; x < width; x += kernel_chunk) {
            const int count = std::min(kernel_chunk, width - x);
            const std::size_t place = static_cast<std::size_t>(y) * width + x;
            float bright[kernel_chunk], squares[2][kernel_chunk] = {};
            for (int i = 0; i < count; ++i)
                bright[i] = brightness_at(coarser, least, place + i);
            for (std::size_t c = 0; c < finer.size(); ++c) {
                const float *fine = finer[c].row(y) + x, *coarse = coarser[c].row(y) + x;
                float* sum = squares[c / 3];
                for (int i = 0; i < count; ++i) {
                    const float d = (fine[i] - coarse[i]) / bright[i];
                    sum[i] += d * d;
                }
            }
            float *size = sizes.row(y) + x, *of_noise = noise.row(y) + x;
            for (int i = 0; i < count; ++i) {
                size[i] = std::sqrt(std::sqrt(squares[0][i]));
                of_noise[i] = std::sqrt(std::sqrt(squares[1][i]));
            }
        }
    });
}

/// Adds c (finer - scratch.coarser) to the sum, where c is trusted over squares of such a radius, by means of
/// roots: in means of squares, the few pixels beside a lamp would decide on all that are near.
/// @param sum  may be scratch.coarser itself
void add_difference(const Planes& finer, int radius, float least, const ParallelFor& parallel_for,
                    Scratch& scratch, Planes& sum) {
    const Planes& coarser = scratch.coarser;
    Plane &sizes = scratch.sizes, &noise = scratch.noise;
    const int width = noise.width(), height = noise.height();
    write_root_sizes(finer, coarser, least, parallel_for, sizes, noise);
    take_wide_means(sizes, radius, scratch.rows, parallel_for);
    take_wide_means(noise, radius, scratch.rows, parallel_for);
    Plane& trust = noise;
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const float ratio = sizes(x, y) > 0 ? noise(x, y) / sizes(x, y) : 1;
            trust(x, y) = std::max(1 - ratio * ratio * ratio * ratio, 0.0f);
        }
    });
    take_wide_means(trust, radius / 2, scratch.rows, parallel_for);
    parallel_for(height, [&](int y) {
        for (std::size_t c = 0; c < sum.size(); ++c)
            for (int x = 0; x < width; ++x)
                sum[c](x, y) += trust(x, y) * (finer[c](x, y) - coarser[c](x, y));
    });
}

bool can_be_squared(const RgbImage& image, const ParallelFor& parallel_for) {
    constexpr float most = 1e28f;
    const auto is_large = [&](std::size_t i) {
        const Rgb c = image.data()[i];
        return !(std::abs(c.r) < most && std::abs(c.g) < most && std::abs(c.b) < most);
    };
    return sum_over_pixels(image.width(), image.height(), parallel_for, is_large) == 0;
}

/// What the brightness of any pixel counts as more; 0: there is as good as no light.
float least_brightness(const Planes& light, const ParallelFor& parallel_for) {
    const double sum = sum_over_pixels(light[0].width(), light[0].height(), parallel_for,
                                       [&](std::size_t i) { return std::max(0.0f, mean_of(light, 0, i)); });
    const float least = dark * static_cast<float>(sum / static_cast<double>(light[0].size()));
    return least < std::numeric_limits<float>::min() ? 0 : least;
}

/// Makes differences, and the light that they are differences to, the radiance of their sum.
void make_radiance(const Planes& light, const GuideImages& guides, const ParallelFor& parallel_for,
                   Planes& differences) {
    for_pixels(light[0].width(), light[0].height(), parallel_for, [&](std::size_t i) {
        const Rgb albedo = seen_albedo(guides, i);
        for (std::size_t c = 0; c < light.size(); ++c) {
            float& value = differences[c].data()[i];
            value = (value + light[c].data()[i]) * albedo[static_cast<int>(c % 3)];
        }
    });
}

/// One over the square of the brightness around each pixel, so that errors count beside it. Around, as pixels that
/// noise makes dark would else count more, and the picture would be darker.
void write_relative_weights(const Planes& radiance, float least, const ParallelFor& parallel_for, Plane& rows,
                            Plane& weights) {
    for_pixels(weights.width(), weights.height(), parallel_for,
               [&](std::size_t i) { weights.data()[i] = brightness_at(radiance, least, i); });
    take_wide_means(weights, weight_radius, rows, parallel_for);
    for_pixels(weights.width(), weights.height(), parallel_for, [&](std::size_t i) {
        float& weight = weights.data()[i]; // at most 1, so that sums of them are numbers
        weight = (least / weight) * (least / weight);
    });
}

/// Radiance becomes what its regression on guides makes of it, and their difference as far as it stands out.
void regress(const GuidePlanes& guides, const ParallelFor& parallel_for, Scratch& scratch, Planes& radiance) {
    const float least = least_brightness(radiance, parallel_for);
    if (least == 0)
        return;
    write_relative_weights(radiance, least, parallel_for, scratch.rows, scratch.sizes);
    write_regressions(radiance, guides, scratch.sizes, parallel_for, scratch.coarser);
    add_difference(radiance, fit_radius, least, parallel_for, scratch, scratch.coarser);
    std::swap(radiance, scratch.coarser);
}

/// Where a difference that stays stands on one that goes, a dark pixel may come out below black: not below what it
/// was.
void write_picture(const Planes& radiance, const ParallelFor& parallel_for, NoisyPicture& picture) {
    for_pixels(picture.image.width(), picture.image.height(), parallel_for, [&](std::size_t i) {
        Rgb &colour = picture.image.data()[i], &noise = picture.noise.data()[i];
        const Rgb least = glm::min(colour, Rgb(0));
        for (std::size_t c = 0; c < 3; ++c) {
            const auto channel = static_cast<int>(c);
            colour[channel] = std::max(radiance[c].data()[i], least[channel]);
            noise[channel] = radiance[c + 3].data()[i];
        }
    });
}

} // namespace

NoisyPicture smooth_by_guides(NoisyPicture picture, const GuideImages& guides, const AlikePixels& alike,
                              const ParallelFor& parallel_for, const SolveWatch& watch) {
    if (!can_be_squared(picture.image, parallel_for) || !can_be_squared(picture.noise, parallel_for))
        return picture;
    Planes finer = light_of(picture, guides, parallel_for);
    const float least = least_brightness(finer, parallel_for);
    if (least == 0)
        return picture;
    const int width = picture.image.width(), height = picture.image.height();
    Planes differences;
    for (Plane& plane : differences)
        plane = filled_image(width, height, 0.0f, parallel_for);
    Scratch scratch = scratch_of(width, height);
    for (std::size_t l = 0; l < levels; ++l) {
        if (!watch.goes_on(static_cast<int>(l), levels + 1))
            return {};
        write_next_level(finer, alike, least, l, parallel_for, scratch);
        add_difference(finer, trust_radius + AlikePixels::steps[l], least, parallel_for, scratch, differences);
        std::swap(finer, scratch.coarser);
    }
    if (!watch.goes_on(levels, levels + 1))
        return {};
    Planes& radiance = differences;
    make_radiance(finer, guides, parallel_for, radiance);
    if (!guides.empty())
        regress(alike.guides(), parallel_for, scratch, radiance);
    write_picture(radiance, parallel_for, picture);
    return picture;
}

std::uint64_t bytes_to_smooth(int width, int height) {
    constexpr std::uint64_t planes =
        3 * std::tuple_size_v<Planes> + std::tuple_size_v<StraightWeights> + 4; // levels, sum, scratch
    return planes * sizeof(float) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

} // namespace tessera
