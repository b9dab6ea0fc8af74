#include "render/surface/texture.h"

#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

Rgb SurfacePoint::attribute(std::string_view name) const {
    const MeshAttribute* found = mesh ? mesh->attribute(name) : nullptr;
    if (!found)
        return Rgb(1);
    const auto value = [&](std::size_t i) { return found->values[i]; };
    if (found->is_of_faces())
        return value(triangle);
    const glm::uvec3 t = mesh->triangles[triangle];
    const float first = 1 - barycentric.x - barycentric.y;
    return first * value(t.x) + barycentric.x * value(t.y) + barycentric.y * value(t.z);
}

namespace {

const std::array<float, 256> linear_of_srgb = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double v = static_cast<double>(i) / 255;
        table[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    return table;
}();

/// Brings a coordinate into [0, 1]; one that is not finite becomes 0.
float wrap(float t, Wrap mode) {
    switch (mode) {
    case Wrap::repeat:
        t -= std::floor(t);
        break;
    case Wrap::mirror:
        t -= 2 * std::floor(t / 2);
        t = t > 1 ? 2 - t : t;
        break;
    case Wrap::clamp:
        t = glm::clamp(t, 0.0f, 1.0f);
        break;
    }
    return t >= 0 && t <= 1 ? t : 0.0f;
}

/// The pixel that stands for one just beyond the edge.
int wrap(int i, int size, Wrap mode) {
    if (i < 0)
        return mode == Wrap::repeat ? size - 1 : 0;
    if (i >= size)
        return mode == Wrap::repeat ? 0 : size - 1;
    return i;
}

Rgb nearest(const Bitmap& bitmap, glm::vec2 uv) {
    const int x = static_cast<int>(uv.x * static_cast<float>(bitmap.width));
    const int y = static_cast<int>(uv.y * static_cast<float>(bitmap.height));
    return bitmap.texel(glm::min(x, bitmap.width - 1), glm::min(y, bitmap.height - 1));
}

/// The four pixels around uv and how far it is from the upper left one; pixels count at their centres, (i + 1/2) /
/// size.
struct Corners {
    Rgb upper_left, upper_right, lower_left, lower_right;
    float right, down; // in [0, 1)
};

Corners corners(const Bitmap& bitmap, glm::vec2 uv, Wrap mode) {
    const float x = uv.x * static_cast<float>(bitmap.width) - 0.5f;
    const float y = uv.y * static_cast<float>(bitmap.height) - 0.5f;
    const float left = std::floor(x);
    const float top = std::floor(y);
    const int x0 = wrap(static_cast<int>(left), bitmap.width, mode);
    const int x1 = wrap(static_cast<int>(left) + 1, bitmap.width, mode);
    const int y0 = wrap(static_cast<int>(top), bitmap.height, mode);
    const int y1 = wrap(static_cast<int>(top) + 1, bitmap.height, mode);
    return {
        bitmap.texel(x0, y0), bitmap.texel(x1, y0), bitmap.texel(x0, y1), bitmap.texel(x1, y1), x - left, y - top};
}

Rgb bilinear(const Bitmap& bitmap, glm::vec2 uv, Wrap mode) {
    const Corners c = corners(bitmap, uv, mode);
    return glm::mix(glm::mix(c.upper_left, c.upper_right, c.right), glm::mix(c.lower_left, c.lower_right, c.right),
                    c.down);
}

/// Derivative of bilinear()'s luminance by u and v.
glm::vec2 bilinear_gradient(const Bitmap& bitmap, glm::vec2 uv, Wrap mode) {
    const Corners c = corners(bitmap, uv, mode);
    const Rgb by_x = glm::mix(c.upper_right - c.upper_left, c.lower_right - c.lower_left, c.down);
    const Rgb by_y = glm::mix(c.lower_left - c.upper_left, c.lower_right - c.upper_right, c.right);
    return {luminance(by_x) * static_cast<float>(bitmap.width),
            luminance(by_y) * static_cast<float>(bitmap.height)};
}

Rgb look_up(const BitmapTexture& texture, glm::vec2 uv) {
    const Bitmap& bitmap = *texture.bitmap;
    uv = {wrap(uv.x, texture.wrap), wrap(uv.y, texture.wrap)};
    return texture.filter == Filter::nearest ? nearest(bitmap, uv) : bilinear(bitmap, uv, texture.wrap);
}

Rgb look_up(const CheckerboardTexture& texture, glm::vec2 uv) {
    const bool right = uv.x - std::floor(uv.x) > 0.5f;
    const bool lower = uv.y - std::floor(uv.y) > 0.5f;
    return right == lower ? texture.color0 : texture.color1;
}

} // namespace

Rgb Bitmap::texel(int x, int y) const {
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    if (bytes.empty())
        return floats[i];
    const std::uint8_t* const p = bytes.data() + 3 * i;
    if (srgb)
        return {linear_of_srgb[p[0]], linear_of_srgb[p[1]], linear_of_srgb[p[2]]};
    return Rgb(p[0], p[1], p[2]) * (1.0f / 255);
}

Rgb Texture::evaluate(const SurfacePoint& at) const {
    if (const Rgb* constant = std::get_if<Rgb>(&kind))
        return *constant;
    const glm::vec2 uv(to_uv * glm::vec3(at.uv, 1));
    if (const auto* bitmap = std::get_if<BitmapTexture>(&kind))
        return scale * look_up(*bitmap, uv);
    if (const auto* checkerboard = std::get_if<CheckerboardTexture>(&kind))
        return scale * look_up(*checkerboard, uv);
    return scale * at.attribute(std::get<AttributeTexture>(kind).name);
}

glm::vec2 Texture::gradient(const SurfacePoint& at) const {
    const auto* texture = std::get_if<BitmapTexture>(&kind);
    if (!texture)
        return glm::vec2(0);
    const glm::vec2 uv(to_uv * glm::vec3(at.uv, 1));
    glm::vec2 by_look_up =
        bilinear_gradient(*texture->bitmap, {wrap(uv.x, texture->wrap), wrap(uv.y, texture->wrap)}, texture->wrap);
    for (int i = 0; i < 2; ++i)
        if (texture->wrap == Wrap::mirror && std::fmod(std::abs(std::floor(uv[i])), 2.0f) == 1)
            by_look_up[i] = -by_look_up[i];         // looked up backward
    return scale * (by_look_up * glm::mat2(to_uv)); // the row vector times the matrix: chain rule
}

Rgb Texture::mean() const {
    if (const Rgb* constant = std::get_if<Rgb>(&kind))
        return *constant;
    if (const auto* checkerboard = std::get_if<CheckerboardTexture>(&kind))
        return 0.5f * scale * (checkerboard->color0 + checkerboard->color1);
    const auto* texture = std::get_if<BitmapTexture>(&kind);
    if (!texture)
        return Rgb(scale);
    glm::dvec3 sum(0);
    for (int y = 0; y < texture->bitmap->height; ++y)
        for (int x = 0; x < texture->bitmap->width; ++x)
            sum += glm::dvec3(texture->bitmap->texel(x, y));
    return scale * Rgb(sum / (double(texture->bitmap->width) * texture->bitmap->height));
}

} // namespace tessera
