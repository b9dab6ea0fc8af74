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

/// The mip levels of a bitmap, made on first use (thread-safe) and shared by copies of this object.
class MipLevels {
public:
    /// Returns the levels below `bitmap` down to one pixel; each averages the one above in linear colour and
    /// halves its size. Empty if the bitmap has one colour.
    const std::vector<Bitmap>& of(const Bitmap& bitmap) const;

private:
    struct Levels;
    std::shared_ptr<Levels> levels_ = make_levels();
    static std::shared_ptr<Levels> make_levels();
};

/// An image as read from a file; 8-bit pixels stay 8-bit to save memory.
struct Bitmap {
    int width = 0;
    int height = 0;
    bool srgb = true;                ///< whether `bytes` are sRGB encoded; else linear
    std::vector<std::uint8_t> bytes; ///< 3 per pixel, rows from the top; empty if `floats` is used
    PixelVector<Rgb> floats;         ///< linear; empty if `bytes` is used
    MipLevels mips{};                ///< for Texture::filtered()

    /// Returns the linear colour of a pixel; the coordinates must be inside the image.
    Rgb texel(int x, int y) const;
};

enum class Filter : std::uint8_t { nearest, bilinear };
enum class Wrap : std::uint8_t { repeat, mirror, clamp };

struct BitmapTexture {
    std::shared_ptr<const Bitmap> bitmap;
    Filter filter = Filter::bilinear;
    Wrap wrap = Wrap::repeat;
};

/// Mitsuba's checkerboard: color0 where both or neither of u and v have a fractional part above 1/2.
struct CheckerboardTexture {
    Rgb color0{0.4f};
    Rgb color1{0.2f};
};

/// Looks up a MeshAttribute.
struct AttributeTexture {
    std::string name;
};

/// A colour over a surface. As in Mitsuba, v = 0 is the top row of a bitmap. The OBJ loader flips v, which counts
/// from the bottom in OBJ files.
struct Texture {
    std::variant<Rgb, BitmapTexture, CheckerboardTexture, AttributeTexture> kind = Rgb(0.5f);
    glm::mat3 to_uv{1.0f}; ///< applied to (u, v, 1) before the look-up
    float scale = 1;       ///< factor on the looked-up value; not applied to constants

    Texture() = default;
    Texture(Rgb constant) : kind(constant) {}

    /// Returns the value at a point, without filtering.
    Rgb evaluate(const SurfacePoint& at) const;

    /// Returns the approximate mean over the footprint of `at`. Meant for parameters in which radiance is linear,
    /// such as reflectances. Equals evaluate() for a footprint that is a point or smaller than a texel, and for
    /// meshes with attributes. See docs/theory.md, "Texture filtering".
    Rgb filtered(const SurfacePoint& at) const;

    /// Returns the luminance; of a constant the red channel, because scalar constants are grey.
    float scalar(const SurfacePoint& at) const {
        const Rgb* constant = std::get_if<Rgb>(&kind);
        return constant ? constant->r : luminance(evaluate(at));
    }

    /// Returns the derivatives of the luminance by u and v; 0 for all kinds except bitmaps.
    glm::vec2 gradient(const SurfacePoint& at) const;

    /// Returns the mean over the whole bitmap or checkerboard, ignoring to_uv; `scale` for attributes.
    Rgb mean() const;

    bool is_black() const { return is_constant() && std::get<Rgb>(kind) == Rgb(0); }
    bool is_constant() const { return std::holds_alternative<Rgb>(kind); }
};

} // namespace tessera
