// Colours, images, rectangles of pixels, and what a gradient-domain method measures: what every room speaks of.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Linear-light red, green and blue (Rec. 709 primaries). As a colour of light the unit is radiance;
/// as a reflectance it has none.
using Rgb = glm::vec3;

/// Relative luminance of Rec. 709 primaries.
inline float luminance(Rgb c) {
    return 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b;
}

/// |c|: luminance, whatever the signs.
inline float size_of(Rgb c) {
    return luminance({std::abs(c.r), std::abs(c.g), std::abs(c.b)});
}

inline bool is_finite(Rgb c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

inline bool is_black(Rgb c) {
    return c.r <= 0 && c.g <= 0 && c.b <= 0;
}

/// Takes the CIE's X, Y and Z of 1931 to linear sRGB [IEC 61966-2-1]; colours outside have negative components.
inline Rgb rgb_of_xyz(glm::vec3 xyz) {
    const glm::mat3 columns(3.240970f, -0.969244f, 0.055630f, -1.537383f, 1.875968f, -0.203977f, -0.498611f,
                            0.041555f, 1.056972f);
    return columns * xyz;
}

/// The CIE's matching functions of 1931, at a wavelength in nm: x, y and z, to about 1 % [Wyman, Sloan and Shirley
/// 2013, eq. 4 and table 1].
inline glm::vec3 color_matching(float nm) {
    const auto bell = [nm](float center, float width_below, float width_above) {
        const float t = (nm - center) / (nm < center ? width_below : width_above);
        return std::exp(-0.5f * t * t);
    };
    return {1.056f * bell(599.8f, 37.9f, 31.0f) + 0.362f * bell(442.0f, 16.0f, 26.7f) -
                0.065f * bell(501.1f, 20.4f, 26.2f),
            0.821f * bell(568.8f, 46.9f, 40.5f) + 0.286f * bell(530.9f, 16.3f, 31.1f),
            1.217f * bell(437.0f, 11.8f, 36.0f) + 0.681f * bell(459.0f, 26.0f, 13.8f)};
}

/// The transfer function of sRGB [IEC 61966-2-1], from code 0 to 1 to linear.
inline float srgb_to_linear(float code) {
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

/// And back, from linear to code.
inline float linear_to_srgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// Memory of pixels that need not be filled before something is written there.
template <class Pixel>
struct PixelAllocator : std::allocator<Pixel> {
    template <class Other>
    struct rebind {
        using other = PixelAllocator<Other>;
    };

    PixelAllocator() = default;
    template <class Other>
    PixelAllocator(const PixelAllocator<Other>&) noexcept {}

    template <class Any, class... Arguments>
    void construct(Any* at, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) == 0)
            ::new (static_cast<void*>(at)) Any; // numbers are left what they are
        else
            ::new (static_cast<void*>(at)) Any(std::forward<Arguments>(arguments)...);
    }
};

/// Beware: resize() leaves new pixels what they are.
template <class Pixel>
using PixelVector = std::vector<Pixel, PixelAllocator<Pixel>>;

/// Instead of a colour: pixels are anything. For an image all of which is written before it is read: a large one
/// is then touched first by the threads that write it, side by side, and not by the one that asks for it.
struct Unfilled {};

/// A raster of pixels, row by row from the top left. An image of width or height 0 is empty.
template <class Pixel>
class Image {
public:
    Image() = default;
    Image(int width, int height, Pixel fill = Pixel{})
        : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height, fill) {}
    Image(int width, int height, Unfilled)
        : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height) {}
    Image(const Image&) = default;
    Image& operator=(const Image&) = default;
    /// The other one is empty then.
    Image(Image&& other) noexcept
        : width_(std::exchange(other.width_, 0)), height_(std::exchange(other.height_, 0)),
          pixels_(std::move(other.pixels_)) {}
    Image& operator=(Image&& other) noexcept {
        width_ = std::exchange(other.width_, 0);
        height_ = std::exchange(other.height_, 0);
        pixels_ = std::exchange(other.pixels_, {});
        return *this;
    }

    int width() const { return width_; }
    int height() const { return height_; }
    bool empty() const { return pixels_.empty(); }
    std::size_t size() const { return pixels_.size(); }

    Pixel& operator()(int x, int y) { return pixels_[static_cast<std::size_t>(y) * width_ + x]; }
    const Pixel& operator()(int x, int y) const { return pixels_[static_cast<std::size_t>(y) * width_ + x]; }
    Pixel* row(int y) { return pixels_.data() + static_cast<std::size_t>(y) * width_; }
    const Pixel* row(int y) const { return pixels_.data() + static_cast<std::size_t>(y) * width_; }
    Pixel* data() { return pixels_.data(); }
    const Pixel* data() const { return pixels_.data(); }

    /// Gives the pixels away, row by row: it is empty then.
    PixelVector<Pixel> take_pixels() {
        width_ = height_ = 0;
        return std::move(pixels_);
    }

    auto begin() { return pixels_.begin(); }
    auto end() { return pixels_.end(); }
    auto begin() const { return pixels_.begin(); }
    auto end() const { return pixels_.end(); }

private:
    int width_ = 0;
    int height_ = 0;
    PixelVector<Pixel> pixels_;
};

using RgbImage = Image<Rgb>;

/// Numbers as shades of grey.
inline RgbImage grey(const Image<float>& numbers) {
    RgbImage image(numbers.width(), numbers.height());
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] = Rgb(numbers.data()[i]);
    return image;
}

/// What makes pictures of a coefficient e = v / a of the radiance v, where a > 0 is about the albedo of what a
/// pixel sees, and 0 where it sees nothing: Lossless Basis Expansion [Fang 2024] with one function. All images of
/// one size, or all empty: then primal and gradients are of v itself.
struct Demodulation {
    RgbImage value;               ///< mean of v, without very direct light
    RgbImage albedo;              ///< mean of a over many points of each pixel, none of them a sample's
    RgbImage sampled_albedo;      ///< mean of the a that the samples were divided by
    Image<float> albedo_variance; ///< of a over the points of each pixel, summed over the channels
    Image<float> sampled_share;   ///< weight of sampled_albedo in the best mean of both, in [0, 1]

    // From sample to sample, per channel; of a single one 0.
    RgbImage sampled_variance; ///< of a
    RgbImage value_covariance; ///< of v with a
    /// Of the mean of e, what is left of it where e follows a; summed over the channels.
    Image<float> unexplained_variance;

    static constexpr std::size_t bytes_a_pixel = 5 * sizeof(Rgb) + 3 * sizeof(float);
    bool empty() const { return albedo.empty(); }
};

/// Part l of a coefficient, by a function of the directions that light comes from [Fang 2024]: e is the sum of
/// projection times part, and each part is smoother than e where normals or roughness change. All images of one
/// size.
struct BasisComponent {
    Image<float> projection; ///< s^l of each pixel
    RgbImage primal, dx, dy; ///< e^l, and its forward differences
    /// Variances of these means, summed over the channels; empty if they are unknown.
    Image<float> primal_variance{}, dx_variance{}, dy_variance{};

    static constexpr std::size_t bytes_a_pixel = 3 * sizeof(Rgb) + 4 * sizeof(float);
};

/// Of each pixel the sample that brought most, in primal or gradients: what the others are to be judged without
/// (recon/guided/fireflies.h). All images of one size, or all empty.
struct BrightestSamples {
    RgbImage primal, dx, dy; ///< of GradientImages; dx and dy empty where these are
    RgbImage albedo;         ///< what its primal was divided by; empty without Demodulation
    Image<float> half;       ///< its weight in HalfDifferences, about 1 or -1; empty without these
    int samples = 0;         ///< that each pixel has, this one among them

    static constexpr std::size_t bytes_a_pixel = 4 * sizeof(Rgb) + sizeof(float);
    bool empty() const { return primal.empty(); }
};

/// What a pixel shows first that is not a mere mirror or clear glass, followed through these: pixels that look
/// alike in it have about the same light.
struct SurfaceFeatures {
    Rgb albedo{0};       ///< of what is seen, times what mirrors and glass on the way leave; 1: nothing is met
    glm::vec3 normal{0}; ///< of shading, unit, in the world; 0: nothing is met
    float nearness = 0;  ///< inverse length of the way, in units of the scene; 0: nothing is met
    float roughness = 0; ///< of what is seen (Bsdf::roughness): 0 as a mirror, 1 diffuse; 0: nothing is met

    void operator+=(const SurfaceFeatures& other) {
        albedo += other.albedo;
        normal += other.normal;
        nearness += other.nearness;
        roughness += other.roughness;
    }
};

/// Means of features over the points of each pixel. All images of one size, or all empty: unknown.
struct FeatureImages {
    RgbImage albedo;
    Image<glm::vec3> normal;
    Image<float> nearness, roughness;

    static constexpr std::size_t bytes_a_pixel = 2 * sizeof(Rgb) + 2 * sizeof(float);
    bool empty() const { return albedo.empty(); }
};

/// Half the difference between what one half of the passes and what the other says, each in the mean: noise alone,
/// and as much of it as is in the mean of all. All images of one size; dx and dy empty without gradients, all
/// empty where they are unknown.
struct HalfDifferences {
    RgbImage primal, dx, dy; ///< of those of GradientImages

    static constexpr std::size_t bytes_a_pixel = 3 * sizeof(Rgb);
    bool empty() const { return primal.empty(); }
};

/// What a gradient-domain method measures, as means over the samples taken; all images of one size.
/// A method without gradients leaves dx and dy empty.
struct GradientImages {
    RgbImage primal;      ///< radiance without what is in very_direct, or its coefficient (Demodulation)
    RgbImage dx;          ///< dx(x, y) estimates I(x+1, y) - I(x, y); the last column is 0 and means nothing
    RgbImage dy;          ///< dy(x, y) estimates I(x, y+1) - I(x, y); the last row is 0 and means nothing
    RgbImage very_direct; ///< emission seen by the camera, straight or in mirrors; added after the reconstruction

    /// Variances of these means, summed over the channels; empty if they are unknown.
    Image<float> primal_variance{}, dx_variance{}, dy_variance{};

    Demodulation demodulation{};
    std::vector<BasisComponent> parts{}; ///< none: the coefficient is reconstructed as a whole
    BrightestSamples brightest{};        ///< empty: unknown
    HalfDifferences halves{};
    FeatureImages features{};

    /// Edge of the squares of pixels whose primals have much the same noise, as tiles that share their light make
    /// it; >= 1, where 1 means that every pixel has its own.
    float patch = 1;

    bool has_gradients() const { return !dx.empty() && !dy.empty(); }
    /// Radiance as sampled, without very direct light.
    const RgbImage& radiance() const { return demodulation.empty() ? primal : demodulation.value; }
    /// Whether all three images have them.
    bool has_variances() const { return !primal_variance.empty() && !dx_variance.empty() && !dy_variance.empty(); }
};

/// A rectangle of pixels: first column and row, and one past the last.
struct PixelRect {
    int x0, y0, x1, y1;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool empty() const { return x0 >= x1 || y0 >= y1; }
    PixelRect clipped(glm::ivec2 size) const {
        return {std::max(x0, 0), std::max(y0, 0), std::min(x1, size.x), std::min(y1, size.y)};
    }
    /// The rectangle with one more column and row, where the image of that size has them: the neighbours to which
    /// forward gradients lead.
    PixelRect with_halo(glm::ivec2 size) const { return PixelRect{x0, y0, x1 + 1, y1 + 1}.clipped(size); }
    bool operator==(const PixelRect&) const = default;
    bool contains(glm::ivec2 p) const { return p.x >= x0 && p.y >= y0 && p.x < x1 && p.y < y1; }
};

/// Calls `visit(square)` for the squares of a given edge that fill a rectangle, row by row; the last ones are cut
/// off.
template <class Visit>
void for_each_square(PixelRect rect, int edge, Visit&& visit) {
    for (int y = rect.y0; y < rect.y1; y += edge)
        for (int x = rect.x0; x < rect.x1; x += edge)
            visit(PixelRect{x, y, std::min(x + edge, rect.x1), std::min(y + edge, rect.y1)});
}

} // namespace tessera
