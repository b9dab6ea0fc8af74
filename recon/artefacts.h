#pragma once

#include "recon/metrics.h"

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// What can be wrong with one image, beside being noisy. All radiances are in units of the reference's mean
/// luminance (in their own, if the reference is black), so that dark scenes are judged as bright ones are.
struct Artefacts {
    FloorFreeError error;       ///< relMSE
    double mean = 0;            ///< luminance; 1 is the reference's, but for a black one's 0
    std::vector<double> worst;  ///< largest relative squared errors of pixels, from the worst on (worst_count)
    glm::ivec2 worst_pixel{0};  ///< where the first of them is
    std::size_t bad_pixels = 0; ///< not finite in these units: they count as black in all that is above
    std::vector<double> pieces; ///< pieces_of the image, by those pixels
};

/// How many of the worst pixels are kept: more than one in a thousand, so that several runs' together tell the
/// 99.99th percentile of all.
std::size_t worst_count(std::size_t pixels);

/// A pixel's squared error is (I - r1)(I - r2) / (r^2 + relative_mse_epsilon), at least 0, so that a spike of one
/// reference is not taken for one of the image. Throws std::invalid_argument if the sizes differ or the images are
/// empty.
Artefacts measure_artefacts(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2);

/// What is known of the two references that images are measured by, in the units of Artefacts. Their noise is
/// taken to be independent from pixel to pixel, as that of naive path tracing is.
struct ReferenceNoise {
    bool is_black = false;
    double mean_error = 0;          ///< standard error of the mean luminance of both references together
    double squared_error_error = 0; ///< that the references give to Artefacts::error, its small bias included
    std::vector<double> pieces[2];  ///< of each reference, as Artefacts::pieces
};

/// Throws as measure_artefacts does.
ReferenceNoise measure_reference_noise(const RgbImage& reference1, const RgbImage& reference2);

} // namespace tessera
