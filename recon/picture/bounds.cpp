#include "recon/picture/bounds.h"

#include "recon/picture/demodulation.h"
#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr std::size_t wide_levels = 3; // of AlikePixels: pixels within 26
constexpr int lit_radius = 6;          // of the squares of pixels that are asked for any light: wider than a tile
constexpr float least_lit = 0.5f;      // share of them
constexpr float most = 1e30f;          // of variances, so that squares stay finite

/// s^2 of the primal, summed over the channels.
Image<float> squared_errors(const Image<float>& variances, const AlikePixels& alike,
                            const ParallelFor& parallel_for) {
    const int width = variances.width(), height = variances.height();
    Image<float> roots(width, height, Unfilled()); // of s
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x)
            roots(x, y) = std::sqrt(std::sqrt(std::min(variances(x, y), most)));
    });
    alike.take_means(wide_levels, roots, parallel_for);
    Image<float> squares(width, height, Unfilled());
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const float around = roots(x, y) * roots(x, y);
            squares(x, y) = std::max(std::min(variances(x, y), most), around * around);
        }
    });
    return squares;
}

/// The share of the pixels around of which any sample has found light.
Image<float> lit_shares(const RgbImage& radiance, const ParallelFor& parallel_for) {
    Image<float> lit(radiance.width(), radiance.height(), Unfilled());
    for_pixels(lit.width(), lit.height(), parallel_for,
               [&](std::size_t i) { lit.data()[i] = is_black(radiance.data()[i]) ? 0.0f : 1.0f; });
    return square_means(lit, lit_radius, 0, 0, parallel_for);
}

/// Looks that lead nowhere, in mirrors and through glass, too, are at no distance.
Image<std::uint8_t> black_pixels(const GuideImages& guides, const RgbImage& found,
                                 const ParallelFor& parallel_for) {
    Image<std::uint8_t> black(found.width(), found.height(), Unfilled());
    for_pixels(found.width(), found.height(), parallel_for, [&](std::size_t i) {
        black.data()[i] = guides.nearness.data()[i] == 0 && found.data()[i] == Rgb(0);
    });
    return black;
}

} // namespace

bool can_bound(const GradientImages& images) {
    return images.patch > 1 && !images.primal_variance.empty() && images.parts.empty();
}

UpperBounds upper_bounds(const GradientImages& images, const GradientImages& given, const AlikePixels& alike,
                         const ParallelFor& parallel_for) {
    UpperBounds bounds;
    if (!given.guides.empty())
        bounds.black = black_pixels(given.guides, given.radiance(), parallel_for);
    if (!can_bound(images))
        return bounds;
    const Image<float> squares = squared_errors(images.primal_variance, alike, parallel_for);
    const Image<float> lit = lit_shares(images.radiance(), parallel_for);
    bounds.light = copy_of(images.primal, parallel_for);
    bounds.error = RgbImage(squares.width(), squares.height(), Unfilled());
    const bool is_demodulated = !images.demodulation.empty();
    if (is_demodulated)
        remodulate(images, false, bounds.light, parallel_for);
    parallel_for(squares.height(), [&](int y) {
        for (int x = 0; x < squares.width(); ++x) {
            const Rgb albedo = is_demodulated ? images.demodulation.sampled_albedo(x, y) : Rgb(1);
            Rgb& light = bounds.light(x, y);
            light = glm::max(light, glm::max(images.radiance()(x, y), Rgb(0)));
            bounds.error(x, y) = lit(x, y) < least_lit ? Rgb(most) : std::sqrt(squares(x, y)) * albedo;
        }
    });
    return bounds;
}

RgbImage take_excess(const UpperBounds& bounds, float reach, RgbImage& image, const ParallelFor& parallel_for) {
    RgbImage excess(image.width(), image.height(), Unfilled());
    parallel_for(image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x) {
            excess(x, y) = Rgb(0);
            if (!bounds.light.empty())
                excess(x, y) = glm::max(image(x, y) - (bounds.light(x, y) + reach * bounds.error(x, y)), Rgb(0));
            if (!bounds.black.empty() && bounds.black(x, y))
                excess(x, y) = image(x, y);
            image(x, y) -= excess(x, y);
        }
    });
    return excess;
}

RgbImage room_below(const UpperBounds& bounds, float reach, const RgbImage& image,
                    const ParallelFor& parallel_for) {
    if (bounds.empty())
        return {};
    RgbImage room(image.width(), image.height(), Unfilled());
    parallel_for(image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x) {
            room(x, y) = Rgb(most);
            if (!bounds.light.empty())
                room(x, y) = bounds.light(x, y) + reach * bounds.error(x, y) - image(x, y);
            if (!bounds.black.empty() && bounds.black(x, y))
                room(x, y) = Rgb(0);
        }
    });
    return room;
}

} // namespace tessera
