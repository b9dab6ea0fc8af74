// Texture::filtered(): means over footprints. Bitmaps have smaller copies of themselves for that, of which one is
// chosen by the narrow side of the footprint, and several points are taken along the wide one [as Suykens
// 2001, 5.1].
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

struct MipLevels::Made {
    std::once_flag once;
    std::vector<Bitmap> levels;
};

std::shared_ptr<MipLevels::Made> MipLevels::make() {
    return std::make_shared<Made>();
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

/// The pixels of a row of `from` that one of `to` is the mean of: the first, and their weights, which sum to 1.
struct Cover {
    int first, count;
    float weights[4];
};

Cover cover(int i, int from, int to) {
    const double scale = static_cast<double>(from) / to, begin = i * scale, end = begin + scale;
    Cover c{static_cast<int>(begin), 0, {}};
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
        const Cover rows = cover(y, bitmap.height, half.height);
        for (int x = 0; x < half.width; ++x) {
            const Cover columns = cover(x, bitmap.width, half.width);
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

/// A footprint as points in a row, each the middle of a parallelogram of the sides `step` and `narrow`.
struct Row {
    int count;
    glm::vec2 first, step, narrow;
    float width; ///< of the parallelograms, at the narrowest
};

/// @param a,b  the sides of the footprint
Row row_of(glm::vec2 middle, glm::vec2 a, glm::vec2 b) {
    constexpr float most = 16;
    if (glm::dot(a, a) < glm::dot(b, b))
        std::swap(a, b);
    const float length = glm::length(a);
    const float width = std::abs(a.x * b.y - a.y * b.x) / length;
    const float count = std::clamp(std::ceil(length / width), 1.0f, most);
    const glm::vec2 step = a / count;
    return {static_cast<int>(count), middle - 0.5f * (count - 1) * step, step, b, std::max(width, length / most)};
}

Rgb filtered(const BitmapTexture& texture, glm::vec2 uv, glm::vec2 along, glm::vec2 across) {
    const Bitmap& bitmap = *texture.bitmap;
    const glm::vec2 size(bitmap.width, bitmap.height);
    const Row row = row_of(uv, along * size, across * size); // but for its middle in pixels of the bitmap
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

/// The mean, over an interval of that length about t, of what is 1 where t has a fraction above one half and -1
/// elsewhere.
float mean_of_steps(float t, float length) {
    const auto fraction = [](float x) { return x - std::floor(x); };
    const float from = t - 0.5f * length, to = t + 0.5f * length;
    // Within a step, rounding must not make a black square grey.
    if (length < 1e-4f || std::floor(2 * from) == std::floor(2 * to))
        return fraction(t) > 0.5f ? 1.0f : -1.0f;
    const auto integral = [&](float x) { return std::abs(fraction(x) - 0.5f); };
    return (integral(to) - integral(from)) / length;
}

/// In closed form over boxes about the points of the row [as Igehy 1999].
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
    const float more = 0.5f * (1 + sum / static_cast<float>(row.count)); // the share of color0
    return glm::mix(texture.color1, texture.color0, more);
}

} // namespace

const std::vector<Bitmap>& MipLevels::of(const Bitmap& bitmap) const {
    std::call_once(made_->once, [&] {
        if (has_one_colour(bitmap))
            return;
        const Bitmap* last = &bitmap;
        made_->levels.reserve(32); // pointers into it must last
        while (last->width > 1 || last->height > 1) {
            made_->levels.push_back(halved(*last));
            last = &made_->levels.back();
        }
    });
    return made_->levels;
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
