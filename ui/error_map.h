#pragma once

#include "recon/image.h"

namespace tessera {

/// How far each pixel of an image I is from a reference r; the mean of the three channels' figures.
enum class ErrorKind {
    relative_squared, ///< (I - r)^2 / (r^2 + relative_mse_epsilon): its mean over the pixels is relMSE
    squared,          ///< (I - r)^2
    absolute,         ///< |I - r|
    relative,         ///< |I - r| / (|r| + mape_epsilon)
};

float pixel_error(ErrorKind kind, const Rgb& value, const Rgb& reference);

inline bool same_size(const RgbImage& a, const RgbImage& b) {
    return a.width() == b.width() && a.height() == b.height();
}

/// Both of one size.
RgbImage error_map(ErrorKind kind, const RgbImage& image, const RgbImage& reference);

} // namespace tessera
