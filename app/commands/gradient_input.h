#pragma once

#include "recon/image.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tessera {

/// Gradients from files, ready to reconstruct from.
struct GradientInput {
    GradientImages images;                         ///< all finite
    std::map<std::string, std::string> attributes; ///< those that this program wrote into an EXR header
    std::size_t repaired = 0;                      ///< values that were no numbers, now 0 or without trust
};

/// Reads one EXR file with layers primal, dx, dy and perhaps direct, or three or four files, EXR (plain RGB) or
/// PFM: primal, dx, dy and perhaps very direct. dx may lack the last column and dy the last row, which mean
/// nothing in any case. The EXR file may also have the variances of the three, as layers primal_variance,
/// dx_variance and dy_variance (sums over the channels, in R). Throws BadInput or another std::exception that
/// names the file: for sizes that do not fit, and for pixels that are not finite unless `repair` makes them 0.
GradientInput read_gradients(const std::vector<std::filesystem::path>& files, bool repair);

/// The first pixel, row by row from the top left, that is not finite, as text: "pixel (3, 4) is (nan, 0, 1)".
/// Empty: there is none.
std::string text_of_bad_pixel(const RgbImage& image);

} // namespace tessera
