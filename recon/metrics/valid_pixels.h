// Pixels that are left out of errors, because an image has no finite value there.
#pragma once

#include "recon/image.h"

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace tessera {

/// Returns the indices, in increasing order, of the pixels at which some image is not finite. All images have one
/// size.
std::vector<std::size_t> invalid_pixels(std::initializer_list<const RgbImage*> images);

/// Returns the image with these pixels black: if they are black in both images, they add nothing to sums of
/// errors.
RgbImage blackened(RgbImage image, const std::vector<std::size_t>& pixels);

/// Returns a row of the other pixels, in their order.
/// @param pixels  increasing indices
RgbImage without(const RgbImage& image, const std::vector<std::size_t>& pixels);

} // namespace tessera
