// Comparison of a picture with a reference, where both are in their common view.
#pragma once

#include "app/experiment/artefacts.h"
#include "recon/image.h"
#include "recon/metrics/metrics.h"
#include "render/io/picture_formats.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

/// A picture with the name of its file, for messages.
struct NamedPicture {
    std::filesystem::path path;
    Picture picture;
};

/// One reference, or two independent ones.
struct References {
    NamedPicture first;
    std::optional<NamedPicture> second;
};

/// A picture and its references, cut to the pixels that all of them have.
struct AlignedPictures {
    RgbImage image, reference1;
    RgbImage reference2;              ///< empty: there is one reference
    PixelRect rect{};                 ///< of these pixels, in the coordinates of the display windows
    std::vector<std::string> notes{}; ///< what was cut

    RgbImage mean_reference() const; ///< mean of both references
};

/// Cuts the pictures to the pixels that all of them have within their display windows. Throws std::runtime_error
/// that names the files if whole pictures differ in size, and if there are no common pixels.
AlignedPictures align(const NamedPicture& image, const References& references);

/// Errors of a picture. Pixels that are not finite in the picture or in a reference are left out of all of them.
struct PictureComparison {
    ErrorMetrics metrics;                                 ///< its bad_pixels is 0
    double psnr = 0, flip = 0;                            ///< recon/metrics/seen_error.h
    double without_light = 0;                             ///< fraction of the pixels with a luminance of 0 or less
    std::size_t pixels = 0;                               ///< pixels compared, those left out included
    std::size_t invalid = 0;                              ///< pixels left out
    std::size_t image_invalid = 0;                        ///< pixels left out that are not finite in the picture
    std::optional<FloorFreeError> floor_free{};           ///< only with two references
    std::optional<std::array<double, 4>> energy_change{}; ///< only with two references
    std::optional<TileSpectrum> tiles{};
};

/// Measures all errors. Throws std::runtime_error if no pixel is finite, and if `tile` is too large for the
/// picture.
/// @param tile  edge of the tiles of the spectrum, in pixels; 0: no spectrum
PictureComparison compare_pictures(const AlignedPictures& pictures, int tile);

} // namespace tessera
