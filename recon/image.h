// Colours, images, rectangles of pixels, and the means that a gradient-domain method measures.
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

/// Returns |c|, the luminance of the channels' absolute values.
inline float size_of(Rgb c) {
    return luminance({std::abs(c.r), std::abs(c.g), std::abs(c.b)});
}

inline bool is_finite(Rgb c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

inline bool is_black(Rgb c) {
    return c.r <= 0 && c.g <= 0 && c.b <= 0;
}

/// Converts CIE 1931 XYZ to linear sRGB [IEC 61966-2-1]. Colours outside the gamut have negative components.
inline Rgb rgb_of_xyz(glm::vec3 xyz) {
    const glm::mat3 columns(3.240970f, -0.969244f, 0.055630f, -1.537383f, 1.875968f, -0.203977f, -0.498611f,
                            0.041555f, 1.056972f);
    return columns * xyz;
}

/// Returns the CIE 1931 colour matching functions x, y and z at a wavelength in nm, to about 1 % [Wyman, Sloan and
/// Shirley 2013, eq. 4 and table 1].
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

/// Converts an sRGB code in [0, 1] to linear [IEC 61966-2-1].
inline float srgb_to_linear(float code) {
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

/// Converts linear to an sRGB code.
inline float linear_to_srgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// Allocator that leaves default-constructed pixels uninitialised.
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
            ::new (static_cast<void*>(at)) Any; // no initialisation of numbers
        else
            ::new (static_cast<void*>(at)) Any(std::forward<Arguments>(arguments)...);
    }
};

/// Beware: resize() leaves new pixels uninitialised.
template <class Pixel>
using PixelVector = std::vector<Pixel, PixelAllocator<Pixel>>;

/// Tag for an image with uninitialised pixels, all of which are written before they are read. The threads that
/// write a large image then touch its pages first, in parallel, and not the thread that creates it.
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
    /// Leaves the other image empty.
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

    /// Moves the pixels out, row by row, and leaves the image empty.
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

/// Returns a grey image of the numbers.
inline RgbImage grey(const Image<float>& numbers) {
    RgbImage image(numbers.width(), numbers.height());
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] = Rgb(numbers.data()[i]);
    return image;
}

/// Data that turn pictures of the coefficient e = v / a into radiance v, theory (27). The albedo a > 0 is
/// approximately that of what the pixel sees, and 0 where it sees nothing: Lossless Basis Expansion [Fang 2024]
/// with one function. All images have one size. If all are empty, primal and gradients are those of v itself.
struct Demodulation {
    RgbImage value;               ///< m(v): mean of v, without directly visible emission
    RgbImage albedo;              ///< A: mean of a over points of the pixel that are no samples
    RgbImage sampled_albedo;      ///< m(a): mean of a over the samples
    Image<float> albedo_variance; ///< V_a: of a over the points of the pixel, summed over the channels
    Image<float> sampled_weight;  ///< weight of m(a) against A in known_albedo(), in [0, 1]

    // Variance and covariance over a pixel's samples, per channel; 0 for one sample.
    RgbImage sampled_variance; ///< of a
    RgbImage value_covariance; ///< of v with a
    /// V_e' of reconstruction (47): variance of m(e) that a does not explain, summed over the channels.
    Image<float> unexplained_variance;

    static constexpr std::size_t bytes_a_pixel = 5 * sizeof(Rgb) + 3 * sizeof(float);
    bool empty() const { return albedo.empty(); }
};

/// Component l of the coefficient e, for one function of the direction that light comes from [Fang 2024]. e is the
/// sum of projection times component, theory (31). Each component is smoother than e where normals or roughness
/// change. All images have one size.
struct BasisComponent {
    Image<float> projection; ///< s^l of each pixel, theory (30)
    RgbImage primal, dx, dy; ///< e^l, and its forward differences
    /// Variances of these means, summed over the channels; empty if they are unknown.
    Image<float> primal_variance{}, dx_variance{}, dy_variance{};

    static constexpr std::size_t bytes_a_pixel = 3 * sizeof(Rgb) + 4 * sizeof(float);
};

/// The brightest sample of each pixel, in primal or gradients (recon/guided/fireflies.h). All images have one
/// size, or all are empty.
struct BrightestSamples {
    RgbImage primal, dx, dy; ///< values of that sample; dx and dy empty as in GradientImages
    RgbImage albedo;         ///< albedo a of that sample; empty without Demodulation
    Image<float> half;       ///< its weight in HalfDifferences, about 1 or -1; empty without them
    int samples = 0;         ///< samples of each pixel, including this one

    static constexpr std::size_t bytes_a_pixel = 4 * sizeof(Rgb) + sizeof(float);
    bool empty() const { return primal.empty(); }
};

/// Features of the first surface on a camera ray that is neither a mirror nor clear glass, reconstruction (43).
struct SurfaceFeatures {
    Rgb albedo{0};       ///< of the surface, times the attenuation by mirrors and glass; 1: no surface
    glm::vec3 normal{0}; ///< shading normal, unit, in world space; 0: no surface
    float nearness = 0;  ///< inverse length of the path to it, in scene units; 0: no surface
    float roughness = 0; ///< Bsdf::roughness: 0 for a mirror, 1 for diffuse; 0: no surface

    void operator+=(const SurfaceFeatures& other) {
        albedo += other.albedo;
        normal += other.normal;
        nearness += other.nearness;
        roughness += other.roughness;
    }
};

/// Feature buffers: means of SurfaceFeatures over points of each pixel. All images have one size, or all are
/// empty.
struct FeatureImages {
    RgbImage albedo;
    Image<glm::vec3> normal;
    Image<float> nearness, roughness;

    static constexpr std::size_t bytes_a_pixel = 2 * sizeof(Rgb) + 2 * sizeof(float);
    bool empty() const { return albedo.empty(); }
};

/// Half differences N of reconstruction (41): they have expectation 0 and the variance of the mean. All images
/// have one size. dx and dy are empty without gradients; all are empty if unknown.
struct HalfDifferences {
    RgbImage primal, dx, dy; ///< of the images of GradientImages

    static constexpr std::size_t bytes_a_pixel = 3 * sizeof(Rgb);
    bool empty() const { return primal.empty(); }
};

/// Means over all samples of a gradient-domain method. All images have one size. dx and dy are empty for a method
/// without gradients.
struct GradientImages {
    RgbImage primal;      ///< radiance without very_direct, or its coefficient e (Demodulation)
    RgbImage dx;          ///< dx(x, y) estimates I(x+1, y) - I(x, y); the last column is 0 and unused
    RgbImage dy;          ///< dy(x, y) estimates I(x, y+1) - I(x, y); the last row is 0 and unused
    RgbImage very_direct; ///< directly visible emission, also in mirrors; added after reconstruction

    /// Variances of these means, summed over the channels; empty if they are unknown.
    Image<float> primal_variance{}, dx_variance{}, dy_variance{};

    Demodulation demodulation{};
    std::vector<BasisComponent> components{}; ///< components of the basis; empty: e is reconstructed as a whole
    BrightestSamples brightest{};             ///< empty: unknown
    HalfDifferences halves{};
    FeatureImages features{};

    /// Edge in pixels, >= 1, of the squares whose primals have correlated noise, such as tiles that reuse paths.
    /// 1: the noise of pixels is independent.
    float patch = 1;

    bool has_gradients() const { return !dx.empty() && !dy.empty(); }
    /// Returns the raw radiance, without directly visible emission.
    const RgbImage& radiance() const { return demodulation.empty() ? primal : demodulation.value; }
    /// Returns whether primal, dx and dy have variances.
    bool has_variances() const { return !primal_variance.empty() && !dx_variance.empty() && !dy_variance.empty(); }
};

/// Rectangle of pixels: first column and row, and one past the last.
struct PixelRect {
    int x0, y0, x1, y1;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool empty() const { return x0 >= x1 || y0 >= y1; }
    PixelRect clipped(glm::ivec2 size) const {
        return {std::max(x0, 0), std::max(y0, 0), std::min(x1, size.x), std::min(y1, size.y)};
    }
    /// Returns the rectangle with one more column and row where the image has them: the pixels to which forward
    /// differences lead.
    PixelRect with_halo(glm::ivec2 size) const { return PixelRect{x0, y0, x1 + 1, y1 + 1}.clipped(size); }
    bool operator==(const PixelRect&) const = default;
    bool contains(glm::ivec2 p) const { return p.x >= x0 && p.y >= y0 && p.x < x1 && p.y < y1; }
};

/// Calls visit(square) for squares of the given edge that cover a rectangle, row by row. The last ones are cut
/// off.
template <class Visit>
void for_each_square(PixelRect rect, int edge, Visit&& visit) {
    for (int y = rect.y0; y < rect.y1; y += edge)
        for (int x = rect.x0; x < rect.x1; x += edge)
            visit(PixelRect{x, y, std::min(x + edge, rect.x1), std::min(y + edge, rect.y1)});
}

} // namespace tessera
