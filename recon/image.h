#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace tessera {

/// Linear-light red, green and blue (Rec. 709 primaries). As a colour of light the unit is radiance;
/// as a reflectance it has none.
using Rgb = glm::vec3;

/// Relative luminance of Rec. 709 primaries.
inline float luminance(Rgb c) {
    return 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b;
}

inline bool is_finite(Rgb c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

inline bool is_black(Rgb c) {
    return c.r <= 0 && c.g <= 0 && c.b <= 0;
}

/// A raster of pixels, row by row from the top left. An image of width or height 0 is empty.
template <class Pixel>
class Image {
public:
    Image() = default;
    Image(int width, int height, Pixel fill = Pixel{})
        : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height, fill) {}

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

    auto begin() { return pixels_.begin(); }
    auto end() { return pixels_.end(); }
    auto begin() const { return pixels_.begin(); }
    auto end() const { return pixels_.end(); }

private:
    int width_ = 0;
    int height_ = 0;
    std::vector<Pixel> pixels_;
};

using RgbImage = Image<Rgb>;

/// Numbers as shades of grey.
inline RgbImage grey(const Image<float>& numbers) {
    RgbImage image(numbers.width(), numbers.height());
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] = Rgb(numbers.data()[i]);
    return image;
}

} // namespace tessera
