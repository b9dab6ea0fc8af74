#pragma once

#include "recon/image.h"

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace tessera {

/// An image as it came from the file; bytes stay bytes, so that a texture takes no more memory than it must.
struct Bitmap {
    int width = 0;
    int height = 0;
    bool srgb = true;                ///< bytes are sRGB encoded; else they are linear
    std::vector<std::uint8_t> bytes; ///< 3 a pixel, rows from the top; empty when `floats` is used
    std::vector<Rgb> floats;         ///< linear; empty when `bytes` is used

    /// Linear colour of a pixel inside the image.
    Rgb texel(int x, int y) const;
};

enum class Filter : std::uint8_t { nearest, bilinear };
enum class Wrap : std::uint8_t { repeat, mirror, clamp };

struct BitmapTexture {
    std::shared_ptr<const Bitmap> bitmap;
    Filter filter = Filter::bilinear;
    Wrap wrap = Wrap::repeat;
};

/// Mitsuba's checkerboard: color0 where both or neither of u and v have a fraction above one half.
struct CheckerboardTexture {
    Rgb color0{0.4f};
    Rgb color1{0.2f};
};

/// A colour over a surface: constant, or looked up at uv. As in Mitsuba, v = 0 is the top of a bitmap; the v of an
/// OBJ file, which counts from the bottom, is turned over when the file is read.
struct Texture {
    std::variant<Rgb, BitmapTexture, CheckerboardTexture> kind = Rgb(0.5f);
    glm::mat3 to_uv{1.0f}; ///< applied to (u, v, 1) before the look-up

    Texture() = default;
    Texture(Rgb constant) : kind(constant) {}

    Rgb evaluate(glm::vec2 uv) const;
    bool is_constant() const { return std::holds_alternative<Rgb>(kind); }
};

} // namespace tessera
