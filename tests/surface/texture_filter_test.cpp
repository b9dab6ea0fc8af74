// Texture::filtered() against means of many points.
#include "render/sampling/sampling.h"
#include "render/surface/texture.h"

#include <cmath>
#include <cstdint>
#include <memory>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

struct Numbers {
    std::uint32_t index = 0;
    float operator()() { return Random(3, ++index, 0).draw(0, Draw::lobe); }
    glm::vec2 pair() { return Random(3, ++index, 0).draw_2d(0, Draw::direction); }
};

/// Returns a bitmap of random greys, or of one grey.
Texture bitmap_texture(int width, int height, bool is_random, Wrap wrap = Wrap::repeat) {
    Bitmap bitmap{width, height, false, {}, {}};
    Numbers next;
    for (int i = 0; i < width * height; ++i)
        bitmap.floats.emplace_back(is_random ? next() : 0.3f);
    Texture texture;
    texture.kind = BitmapTexture{std::make_shared<const Bitmap>(bitmap), Filter::bilinear, wrap};
    return texture;
}

Texture checkerboard(Rgb color0, Rgb color1) {
    Texture texture;
    texture.kind = CheckerboardTexture{color0, color1};
    return texture;
}

SurfacePoint point(glm::vec2 uv, glm::vec2 along, glm::vec2 across) {
    SurfacePoint at(uv);
    at.footprint = {along, across};
    return at;
}

/// Returns the mean of evaluate() over a grid of points in the footprint.
float mean_of_points(const Texture& texture, const SurfacePoint& at) {
    constexpr int n = 64;
    float sum = 0;
    for (int i = 0; i < n * n; ++i) {
        const glm::vec2 s = (glm::vec2(i % n, i / n) + 0.5f) / float(n) - 0.5f;
        sum += texture.evaluate(SurfacePoint(at.uv + s.x * at.footprint.along + s.y * at.footprint.across)).g;
    }
    return sum / float(n * n);
}

/// Rms deviations of filtered() and evaluate() from the mean over the footprint.
struct Deviations {
    double filtered = 0, evaluated = 0;
};

/// Measures deviations for random footprints with these side lengths.
Deviations deviations(const Texture& texture, float along, float across) {
    Numbers next;
    Deviations d;
    constexpr int count = 300;
    for (int i = 0; i < count; ++i) {
        const float angle = 6.2831853f * next();
        const glm::vec2 a(std::cos(angle), std::sin(angle)), b(-a.y, a.x);
        const SurfacePoint at = point(next.pair() * 5.0f - 2.0f, a * along, b * across);
        const float mean = mean_of_points(texture, at);
        d.filtered += std::pow(texture.filtered(at).g - mean, 2);
        d.evaluated += std::pow(texture.evaluate(at).g - mean, 2);
    }
    return {std::sqrt(d.filtered / count), std::sqrt(d.evaluated / count)};
}

TEST(TextureFilter, ApproximatesTheMeanOverTheFootprint) {
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror}) {
        const Texture t = bitmap_texture(61, 34, true, wrap);
        for (const float across : {0.05f, 0.1f, 0.3f})
            for (const float stretch : {1.0f, 3.0f, 10.0f}) {
                const Deviations d = deviations(t, across * stretch, across);
                EXPECT_LT(d.filtered, 0.55 * d.evaluated) << across << " x " << stretch;
            }
    }
    for (const float across : {0.1f, 0.4f, 2.0f})
        for (const float stretch : {1.0f, 3.0f, 10.0f}) {
            const Deviations d = deviations(checkerboard(Rgb(0.9f), Rgb(0.1f)), across * stretch, across);
            EXPECT_LT(d.filtered, 0.55 * d.evaluated) << across << " x " << stretch;
        }
}

TEST(TextureFilter, IsExactOnCheckerboardsForBoxes) {
    const Texture t = checkerboard(Rgb(0.9f), Rgb(0.1f));
    Numbers next;
    for (int i = 0; i < 200; ++i) {
        const glm::vec2 sides = 0.05f + 2.0f * next.pair();
        const SurfacePoint at = point(next.pair() * 9.0f - 4.0f, {sides.x, 0}, {0, sides.y});
        EXPECT_NEAR(t.filtered(at).g, mean_of_points(t, at), 0.03f); // the mean of 64x64 points is inexact
    }
}

TEST(TextureFilter, KeepsTheMean) {
    for (const Texture& t : {bitmap_texture(61, 34, true), bitmap_texture(64, 1, true), bitmap_texture(3, 5, true),
                             checkerboard(Rgb(0.9f), Rgb(0.1f))})
        for (const float across : {0.02f, 0.11f, 0.5f, 4.0f}) {
            double sum = 0;
            constexpr int n = 200;
            for (int i = 0; i < n * n; ++i)
                sum += t.filtered(point((glm::vec2(i % n, i / n) + 0.5f) / float(n), {2.5f * across, across},
                                        {-across, 0.4f * across}))
                           .g;
            EXPECT_NEAR(sum / (n * n) / t.mean().g, 1, 2e-3) << across;
        }
}

TEST(TextureFilter, OneColourHasTheSameBits) {
    Numbers next;
    Texture bitmap = bitmap_texture(3, 7, false), board = checkerboard(Rgb(0.7f), Rgb(0.7f));
    bitmap.scale = board.scale = 1.3f;
    for (int i = 0; i < 1000; ++i) {
        const SurfacePoint at = point(next.pair() * 9.0f - 4.0f, next.pair(), -next.pair());
        for (const Texture& t : {bitmap, board, Texture(Rgb(0.4f))})
            EXPECT_EQ(t.filtered(at), t.evaluate(at));
    }
}

TEST(TextureFilter, DoesNotFilterFootprintsBelowATexel) {
    const Texture t = bitmap_texture(61, 34, true), board = checkerboard(Rgb(0.9f), Rgb(0.1f));
    Numbers next;
    for (int i = 0; i < 1000; ++i) {
        const glm::vec2 uv = next.pair() * 9.0f - 4.0f;
        EXPECT_EQ(t.filtered(SurfacePoint(uv)), t.evaluate(SurfacePoint(uv)));
        EXPECT_EQ(board.filtered(SurfacePoint(uv)), board.evaluate(SurfacePoint(uv)));
        const SurfacePoint small = point(uv, {0.9f / 61, 0}, {0, 0.9f / 34});
        EXPECT_EQ(t.filtered(small), t.evaluate(small));
    }
}

} // namespace

} // namespace tessera
