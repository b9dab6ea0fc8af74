// Conversion of the colours of an OpenEXR file to linear light with Rec. 709 primaries.
#pragma once

#include "recon/image.h"

#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// CIE 1931 x and y of the primaries and of white; the defaults are Rec. 709.
struct Chromaticities {
    glm::dvec2 red{0.64, 0.33}, green{0.30, 0.60}, blue{0.15, 0.06}, white{0.3127, 0.3290};
};

/// Returns the matrix from linear RGB of these primaries to CIE XYZ, where white (1, 1, 1) has Y = 1. Throws
/// std::runtime_error if the primaries lie on a line, or white has no luminance.
glm::dmat3 xyz_of_primaries(const Chromaticities& c);

/// Returns the matrix from linear RGB of these primaries to RGB of Rec. 709. White stays white, by adaptation of
/// its XYZ in the cone space of Bradford [Lindbloom, "Chromatic Adaptation"]. With the primaries of CIE XYZ the
/// values are X, Y and Z whatever the white, as programs write them. Empty: the primaries equal Rec. 709 to 0.001.
/// Throws as xyz_of_primaries() does.
std::optional<glm::dmat3> rec709_of_primaries(const Chromaticities& c);

/// Converts Y, RY = (R - Y) / Y and BY = (B - Y) / Y to R, G and B [OpenEXR, ImfRgbaYca.h].
/// @param weights  of R, G and B in Y: the second row of xyz_of_primaries()
Rgb rgb_of_luminance_chroma(Rgb y_ry_by, glm::dvec3 weights);

/// Enlarges an image of samples at every `step`-th column and row to that size, linearly between the samples.
Image<float> upsampled(const Image<float>& samples, glm::ivec2 step, int width, int height);

} // namespace tessera
