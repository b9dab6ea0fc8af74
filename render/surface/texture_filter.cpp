// Texture::filtered(): means over footprints. The narrow side of a footprint selects the mip level of a bitmap,
// and several points are averaged along the wide side [Suykens 2001, 5.1].
#include "render/surface/texture.h"
#include "render/surface/texture_lookup.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

struct MipLevels::Levels {
    std::once_flag once;
    std::vector<Bitmap> levels;
};

std::shared_ptr<MipLevels::Levels> MipLevels::make_levels() {
    return std::make_shared<Levels>();
}

namespace {

bool has_one_colour(const Bitmap& bitmap) {
    const Rgb first = bitmap.texel(0, 0);
    for (int y = 0; y < bitmap.height; ++y)
        for (int x = 0; x < bitmap.width; ++x)
            if (bitmap.texel(x, y) != first)
                return false;
    return true;
}

/// Consecutive source pixels with weights that sum to 1.
struct WeightedPixels {
    int first, count;
    float weights[4];
};

/// Returns the pixels of a row of `from` pixels whose mean is pixel i of a row of `to` pixels.
WeightedPixels covered_pixels(int i, int from, int to) {
    const double scale = static_cast<double>(from) / to, begin = i * scale, end = begin + scale;
    WeightedPixels c{static_cast<int>(begin), 0, {}};
    for (int x = c.first; x < from && x < end - 1e-9; ++x)
        c.weights[c.count++] = static_cast<float>((std::min(end, x + 1.0) - std::max<double>(begin, x)) / scale);
    return c;
}

Bitmap halved(const Bitmap& bitmap) {
    Bitmap half;
    half.width = std::max(bitmap.width / 2, 1);
    half.height = std::max(bitmap.height / 2, 1);
    half.floats.reserve(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
    for (int y = 0; y < half.height; ++y) {
        const WeightedPixels rows = covered_pixels(y, bitmap.height, half.height);
        for (int x = 0; x < half.width; ++x) {
            const WeightedPixels columns = covered_pixels(x, bitmap.width, half.width);
            Rgb sum(0);
            for (int j = 0; j < rows.count; ++j)
                for (int i = 0; i < columns.count; ++i)
                    sum +=
                        bitmap.texel(columns.first + i, rows.first + j) * (rows.weights[j] * columns.weights[i]);
            half.floats.push_back(sum);
        }
    }
    return half;
}

/// A footprint divided into a row of parallelograms with sides `step` and `narrow`; `first` is the first centre.
struct Row {
    int count;
    glm::vec2 first, step, narrow;
    float width; ///< smallest width of a parallelogram
};

/// Divides a footprint with sides a and b.
Row row_of(glm::vec2 middle, glm::vec2 a, glm::vec2 b) {
    constexpr float max_count = 16;
    if (glm::dot(a, a) < glm::dot(b, b))
        std::swap(a, b);
    const float length = glm::length(a);
    const float width = std::abs(a.x * b.y - a.y * b.x) / length;
    const float count = std::clamp(std::ceil(length / width), 1.0f, max_count);
    const glm::vec2 step = a / count;
    return {static_cast<int>(count), middle - 0.5f * (count - 1) * step, step, b,
            std::max(width, length / max_count)};
}

Rgb filtered(const BitmapTexture& texture, glm::vec2 uv, glm::vec2 along, glm::vec2 across) {
    const Bitmap& bitmap = *texture.bitmap;
    const glm::vec2 size(bitmap.width, bitmap.height);
    const Row row = row_of(uv, along * size, across * size); // in texels, except for uv, the centre
    if (!(row.width > 1))
        return look_up(texture, uv);
    const std::vector<Bitmap>& mips = bitmap.mips.of(bitmap);
    if (mips.empty())
        return look_up(texture, uv);
    const auto last = static_cast<float>(mips.size());
    const float level = std::min(std::log2(row.width), last), finer = std::min(std::floor(level), last - 1);
    const auto at_level = [&](int i, glm::vec2 point) {
        if (i == 0)
            return look_up(texture, point);
        point = {wrap(point.x, texture.wrap), wrap(point.y, texture.wrap)};
        return bilinear(mips[i - 1], point, texture.wrap);
    };
    Rgb sum(0);
    for (int i = 0; i < row.count; ++i) {
        const glm::vec2 point = uv + (row.first - uv + static_cast<float>(i) * row.step) / size;
        sum += glm::mix(at_level(static_cast<int>(finer), point), at_level(static_cast<int>(finer) + 1, point),
                        level - finer);
    }
    return sum / static_cast<float>(row.count);
}

/// Returns the mean over an interval centred at t of a square wave: 1 if the fractional part exceeds 1/2, else
/// -1.
float mean_of_steps(float t, float length) {
    const auto fraction = [](float x) { return x - std::floor(x); };
    const float from = t - 0.5f * length, to = t + 0.5f * length;
    // Exact within one step, where the difference of integrals would round.
    if (length < 1e-4f || std::floor(2 * from) == std::floor(2 * to))
        return fraction(t) > 0.5f ? 1.0f : -1.0f;
    const auto integral = [&](float x) { return std::abs(fraction(x) - 0.5f); };
    return (integral(to) - integral(from)) / length;
}

/// Integrates in closed form over boxes around the points of the row [Igehy 1999].
Rgb filtered(const CheckerboardTexture& texture, glm::vec2 uv, glm::vec2 along, glm::vec2 across) {
    if (texture.color0 == texture.color1)
        return texture.color0;
    const Row row = row_of(uv, along, across);
    const glm::vec2 box = glm::abs(row.step) + glm::abs(row.narrow);
    float sum = 0;
    for (int i = 0; i < row.count; ++i) {
        const glm::vec2 point = row.first + static_cast<float>(i) * row.step;
        sum += mean_of_steps(point.x, box.x) * mean_of_steps(point.y, box.y);
    }
    const float fraction0 = 0.5f * (1 + sum / static_cast<float>(row.count));
    return glm::mix(texture.color1, texture.color0, fraction0);
}

} // namespace

const std::vector<Bitmap>& MipLevels::of(const Bitmap& bitmap) const {
    std::call_once(levels_->once, [&] {
        if (has_one_colour(bitmap))
            return;
        const Bitmap* last = &bitmap;
        levels_->levels.reserve(32); // `last` points into it
        while (last->width > 1 || last->height > 1) {
            levels_->levels.push_back(halved(*last));
            last = &levels_->levels.back();
        }
    });
    return levels_->levels;
}

Rgb Texture::filtered(const SurfacePoint& at) const {
    if (const Rgb* constant = std::get_if<Rgb>(&kind))
        return *constant;
    if (at.mesh || at.footprint.along == glm::vec2(0))
        return evaluate(at);
    const glm::mat2 turn(to_uv);
    const glm::vec2 along = turn * at.footprint.along, across = turn * at.footprint.across;
    if (!(glm::dot(along, along) > 0) || !(glm::dot(across, across) > 0))
        return evaluate(at);
    const glm::vec2 uv(to_uv * glm::vec3(at.uv, 1));
    if (const auto* bitmap = std::get_if<BitmapTexture>(&kind))
        return scale * tessera::filtered(*bitmap, uv, along, across);
    if (const auto* checkerboard = std::get_if<CheckerboardTexture>(&kind))
        return scale * tessera::filtered(*checkerboard, uv, along, across);
    return evaluate(at);
}

} // namespace tessera
