#include "recon/picture/guided.h"

#include "recon/picture/guide_kernel.h"
#include "recon/picture/guide_regression.h"
#include "recon/picture/light_planes.h"
#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <utility>

namespace tessera {

namespace {

// Tried on Veach, Ajar, Country Kitchen and Bathroom at 5 and 20 CPU seconds: none of these numbers matters by
// more than a few percent when it is halved or doubled.
constexpr std::size_t levels = SmoothingFit::levels;
static_assert(levels <= AlikePixels::steps.size());
constexpr int noise_radius = 6; // of the squares that tell noise,
constexpr int trust_radius = 6; // and how far a difference is more than that; wider by the level's step
constexpr int fit_radius = 3;   // likewise of the regression, which is of 5x5 pixels

/// Planes that are used at every level: memory that is new each time costs a quarter of the smoothing.
struct Scratch {
    NoisyPlanes coarser;
    StraightWeights weights;
    Plane brightness, noise, sizes, pairs, rows;
};

Scratch scratch_of(int width, int height) {
    Scratch scratch;
    make_planes(scratch.coarser, width, height);
    make_planes(scratch.weights, width, height);
    for (Plane* plane : {&scratch.brightness, &scratch.noise, &scratch.sizes, &scratch.pairs, &scratch.rows})
        *plane = Plane(width, height, Unfilled());
    return scratch;
}

/// How much pixels of a level count for each other.
void write_level_weights(const NoisyPlanes& light, const AlikePixels& alike, float least, std::size_t level,
                         const ParallelFor& parallel_for, Scratch& scratch) {
    const int step = AlikePixels::steps[level];
    Plane &brightness = scratch.brightness, &noise = scratch.noise;
    const int width = noise.width();
    for_pixels(noise.width(), noise.height(), parallel_for, [&](std::size_t i) {
        const float bright = brightness_at(light, least, i);
        noise.data()[i] = std::abs(mean_of(light, 3, i)) / bright;
        brightness.data()[i] = std::log(bright);
    });
    take_wide_means(noise, noise_radius + step, scratch.rows, parallel_for);
    parallel_for(noise.height(), [&](int y) {
        constexpr float of_gaussian =
            std::numbers::pi_v<float> / 2; // variance over the mean absolute value's square
        for (int x = 0; x < width; ++x)
            noise(x, y) *= of_gaussian * noise(x, y);
    });
    write_noisy_weights(alike.weights(level), brightness, noise, step, parallel_for, scratch.pairs, scratch.rows,
                        scratch.weights);
}

/// The roots of how large differences are beside the coarser picture's brightness, of the picture and of its
/// noise.
void write_root_sizes(const NoisyPlanes& finer, const NoisyPlanes& coarser, float least,
                      const ParallelFor& parallel_for, Plane& sizes, Plane& noise) {
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

/// Writes c of finer - scratch.coarser to scratch.noise, over squares of such a radius, by means of roots: in
/// means of squares, the few pixels beside a lamp would decide on all that are near.
void write_trust(const NoisyPlanes& finer, int radius, float least, const ParallelFor& parallel_for,
                 Scratch& scratch) {
    Plane &sizes = scratch.sizes, &noise = scratch.noise;
    const int width = noise.width();
    write_root_sizes(finer, scratch.coarser, least, parallel_for, sizes, noise);
    take_wide_means(sizes, radius, scratch.rows, parallel_for);
    take_wide_means(noise, radius, scratch.rows, parallel_for);
    Plane& trust = noise;
    parallel_for(noise.height(), [&](int y) {
        for (int x = 0; x < width; ++x) {
            const float ratio = sizes(x, y) > 0 ? noise(x, y) / sizes(x, y) : 1;
            trust(x, y) = std::max(1 - ratio * ratio * ratio * ratio, 0.0f);
        }
    });
    take_wide_means(trust, radius / 2, scratch.rows, parallel_for);
}

/// Gives a scratch plane to a fit, and has another in its place.
template <class Number>
void keep(Image<Number>& scratch, Image<Number>& kept) {
    const int width = scratch.width(), height = scratch.height();
    kept = std::exchange(scratch, Image<Number>(width, height, Unfilled()));
}

void keep_level(Scratch& scratch, std::size_t level, SmoothingFit* fit) {
    if (!fit)
        return;
    for (std::size_t k = 0; k < scratch.weights.size(); ++k)
        keep(scratch.weights[k], fit->weights[level][k]);
    keep(scratch.noise, fit->trust[level]);
}

bool can_be_squared(const RgbImage& image, const ParallelFor& parallel_for) {
    constexpr float most = 1e28f;
    const auto is_large = [&](std::size_t i) {
        const Rgb c = image.data()[i];
        return !(std::abs(c.r) < most && std::abs(c.g) < most && std::abs(c.b) < most);
    };
    return sum_over_pixels(image.width(), image.height(), parallel_for, is_large) == 0;
}

/// Radiance becomes what its regression on guides makes of it, and their difference as far as it stands out.
void regress(const GuidePlanes& guides, const ParallelFor& parallel_for, SmoothingFit* fit, Scratch& scratch,
             NoisyPlanes& radiance) {
    const float least = least_brightness(radiance, parallel_for);
    if (least == 0)
        return;
    write_relative_weights(radiance, least, parallel_for, scratch.rows, scratch.sizes);
    write_regressions(radiance, guides, scratch.sizes, parallel_for, scratch.coarser);
    write_trust(radiance, fit_radius, least, parallel_for, scratch);
    add_difference(scratch.noise, radiance, scratch.coarser, parallel_for, scratch.coarser);
    std::swap(radiance, scratch.coarser);
    if (fit)
        keep(scratch.noise, fit->trust[levels]);
}

} // namespace

NoisyPicture smooth_by_guides(NoisyPicture picture, const GuideImages& guides, const AlikePixels& alike,
                              const ParallelFor& parallel_for, const SolveWatch& watch, SmoothingFit* fit) {
    if (fit)
        *fit = {};
    if (!can_be_squared(picture.image, parallel_for) || !can_be_squared(picture.noise, parallel_for))
        return picture;
    const int width = picture.image.width(), height = picture.image.height();
    NoisyPlanes finer;
    make_planes(finer, width, height);
    write_light(picture.image, guides, 0, parallel_for, finer);
    write_light(picture.noise, guides, 3, parallel_for, finer);
    const float least = least_brightness(finer, parallel_for);
    if (least == 0)
        return picture;
    auto differences = black_planes<NoisyPlanes>(width, height, parallel_for);
    Scratch scratch = scratch_of(width, height);
    for (std::size_t l = 0; l < levels; ++l) {
        if (!watch.goes_on(static_cast<int>(l), levels + 1))
            return {};
        const int step = AlikePixels::steps[l];
        write_level_weights(finer, alike, least, l, parallel_for, scratch);
        write_kernel_means(finer, scratch.weights, step, parallel_for, scratch.coarser);
        write_trust(finer, trust_radius + step, least, parallel_for, scratch);
        add_difference(scratch.noise, finer, scratch.coarser, parallel_for, differences);
        keep_level(scratch, l, fit);
        std::swap(finer, scratch.coarser);
    }
    if (!watch.goes_on(levels, levels + 1))
        return {};
    NoisyPlanes& radiance = differences;
    make_radiance(finer, guides, parallel_for, radiance);
    if (!guides.empty())
        regress(alike.guides(), parallel_for, fit, scratch, radiance);
    write_picture(radiance, parallel_for, picture.image);
    write_noise(radiance, parallel_for, picture.noise);
    return picture;
}

namespace {

/// Writes the next level, and adds c times the difference to it to the sum.
void write_next_level(const Planes& finer, const StraightWeights& weights, int step, const Plane& trust,
                      const ParallelFor& parallel_for, Planes& coarser, Planes& sum) {
    for_kernel_sums(finer, weights, step, parallel_for, [&](int y, const auto& sums) {
        float of_weights[kernel_chunk];
        sums.write_weights(of_weights);
        const float* c = trust.row(y) + sums.begin;
        for (std::size_t k = 0; k < sum.size(); ++k) {
            const float* fine = finer[k].row(y) + sums.begin;
            float *coarse = coarser[k].row(y) + sums.begin, *all = sum[k].row(y) + sums.begin;
            for (int i = 0; i < sums.end - sums.begin; ++i) {
                coarse[i] = sums.values[k][i] / of_weights[i];
                all[i] += c[i] * (fine[i] - coarse[i]);
            }
        }
    });
}

} // namespace

RgbImage smooth_likewise(RgbImage picture, const GuideImages& guides, const AlikePixels& alike,
                         const SmoothingFit& fit, const ParallelFor& parallel_for, const SolveWatch& watch) {
    if (!can_be_squared(picture, parallel_for))
        return picture;
    const int width = picture.width(), height = picture.height();
    Planes finer, coarser;
    make_planes(finer, width, height);
    make_planes(coarser, width, height);
    write_light(picture, guides, 0, parallel_for, finer);
    auto radiance = black_planes<Planes>(width, height, parallel_for);
    for (std::size_t l = 0; l < levels; ++l) {
        if (!watch.goes_on(static_cast<int>(l), levels + 1))
            return {};
        write_next_level(finer, fit.weights[l], AlikePixels::steps[l], fit.trust[l], parallel_for, coarser,
                         radiance);
        std::swap(finer, coarser);
    }
    if (!watch.goes_on(levels, levels + 1))
        return {};
    make_radiance(finer, guides, parallel_for, radiance);
    const float least_of_radiance = least_brightness(radiance, parallel_for);
    if (!fit.trust[levels].empty() && least_of_radiance > 0) {
        Plane weights(width, height, Unfilled()), rows(width, height, Unfilled());
        write_relative_weights(radiance, least_of_radiance, parallel_for, rows, weights);
        write_regressions(radiance, alike.guides(), weights, parallel_for, coarser);
        add_difference(fit.trust[levels], radiance, coarser, parallel_for, coarser);
        std::swap(radiance, coarser);
    }
    write_picture(radiance, parallel_for, picture);
    return picture;
}

std::uint64_t bytes_to_smooth(int width, int height) {
    constexpr std::uint64_t planes = 3 * std::tuple_size_v<NoisyPlanes> + 5; // levels, sum, scratch
    return (planes * sizeof(float) + straight_pairs * sizeof(PairWeight)) * static_cast<std::uint64_t>(width) *
           static_cast<std::uint64_t>(height);
}

} // namespace tessera
