#include "render/surface/texture.h"

#include "render/surface/texture_lookup.h"

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
        return value(on_mesh.triangle);
    const glm::uvec3 t = mesh->triangles[on_mesh.triangle];
    const glm::vec2 barycentric = on_mesh.barycentric;
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

/// Returns the derivatives of the luminance of bilinear() by u and v.
glm::vec2 bilinear_gradient(const Bitmap& bitmap, glm::vec2 uv, Wrap mode) {
    const Corners c = corners(bitmap, uv, mode);
    const Rgb by_x = glm::mix(c.upper_right - c.upper_left, c.lower_right - c.lower_left, c.down);
    const Rgb by_y = glm::mix(c.lower_left - c.upper_left, c.lower_right - c.upper_right, c.right);
    return {luminance(by_x) * static_cast<float>(bitmap.width),
            luminance(by_y) * static_cast<float>(bitmap.height)};
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
            by_look_up[i] = -by_look_up[i];         // mirrored repetition
    return scale * (by_look_up * glm::mat2(to_uv)); // chain rule: row vector times matrix
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
