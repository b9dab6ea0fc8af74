#pragma once

#include "recon/image.h"

namespace tessera {

/// Error of a pixel of image I relative to reference r; mean of the three channels.
enum class ErrorKind {
    relative_squared, ///< (I - r)^2 / (r^2 + relative_mse_epsilon): its mean over the pixels is relMSE
    squared,          ///< (I - r)^2
    absolute,         ///< |I - r|
    relative,         ///< |I - r| / (|r| + mape_epsilon)
};

/// Returns the error of one pixel.
float pixel_error(ErrorKind kind, const Rgb& value, const Rgb& reference);

/// Returns the errors of all pixels. Both images must have the same size.
RgbImage error_map(ErrorKind kind, const RgbImage& image, const RgbImage& reference);

} // namespace tessera
