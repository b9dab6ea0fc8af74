#pragma once

#include "recon/image.h"
#include "render/surface/mesh.h"

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace tessera {

struct Bitmap;

/// Smaller and smaller copies of a bitmap, down to a pixel; made when they are first asked for, by any thread, and
/// shared by copies.
class MipLevels {
public:
    /// Each half the size of the one before, the first of `bitmap`: means of its pixels, linear. None: the bitmap
    /// has but one colour, or one pixel.
    const std::vector<Bitmap>& of(const Bitmap& bitmap) const;

private:
    struct Made;
    std::shared_ptr<Made> made_ = make();
    static std::shared_ptr<Made> make();
};

/// An image as it came from the file; bytes stay bytes, so that a texture takes no more memory than it must.
struct Bitmap {
    int width = 0;
    int height = 0;
    bool srgb = true;                ///< bytes are sRGB encoded; else they are linear
    std::vector<std::uint8_t> bytes; ///< 3 a pixel, rows from the top; empty when `floats` is used
    PixelVector<Rgb> floats;         ///< linear; empty when `bytes` is used
    MipLevels mips{};                ///< what Texture::filtered() has made of it

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

/// What the mesh itself has at its vertices or on its faces (MeshAttribute).
struct AttributeTexture {
    std::string name;
};

/// A colour over a surface: constant, or looked up. As in Mitsuba, v = 0 is the top of a bitmap; the v of an
/// OBJ file, which counts from the bottom, is turned over when the file is read.
struct Texture {
    std::variant<Rgb, BitmapTexture, CheckerboardTexture, AttributeTexture> kind = Rgb(0.5f);
    glm::mat3 to_uv{1.0f}; ///< applied to (u, v, 1) before the look-up
    float scale = 1;       ///< factor on what was looked up; constants have it in them

    Texture() = default;
    Texture(Rgb constant) : kind(constant) {}

    Rgb evaluate(const SurfacePoint& at) const;

    /// About its mean over the footprint of `at`, for what a picture is linear in, such as reflectances; the same
    /// as evaluate() where the footprint is a point, or smaller than a pixel of a bitmap, and where there is but
    /// one colour. Where attributes of a mesh are looked up nothing is filtered.
    Rgb filtered(const SurfacePoint& at) const;

    /// Its luminance; quick where it is constant, and then the red channel: it is grey.
    float scalar(const SurfacePoint& at) const {
        const Rgb* constant = std::get_if<Rgb>(&kind);
        return constant ? constant->r : luminance(evaluate(at));
    }

    /// Derivatives of the luminance by u and v. 0 for all but bitmaps: a checkerboard has only steps.
    glm::vec2 gradient(const SurfacePoint& at) const;

    /// The mean over uv in [0, 1]^2 before to_uv; of attributes white.
    Rgb mean() const;

    bool is_black() const { return is_constant() && std::get<Rgb>(kind) == Rgb(0); }
    bool is_constant() const { return std::holds_alternative<Rgb>(kind); }
};

} // namespace tessera
