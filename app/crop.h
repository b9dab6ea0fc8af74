#pragma once

#include "recon/image.h"
#include "render/method/pixel_rect.h"

#include <vector>

namespace tessera {

/// Up to `count` squares of the image that do not overlap, where the pictures err most, all of them together: of
/// the squares of that edge the one with the largest sum of relative squared errors, in which no pixel counts for
/// more than 1, then the next. All images are of one size; the edge is cut to that.
std::vector<PixelRect> choose_crops(const RgbImage& reference, const std::vector<const RgbImage*>& pictures,
                                    int edge, int count);

/// That part of the image, which must lie in it.
RgbImage crop(const RgbImage& image, PixelRect rect);

/// The exposure, for write_png, that brings nine tenths of the pixels to below 0.8.
float usual_exposure(const RgbImage& image);

} // namespace tessera
