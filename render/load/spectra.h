#pragma once

#include "recon/image.h"

#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// Linear sRGB of a spectrum given at increasing wavelengths (nm, value), linear between them and 0 beyond. White
/// is the spectrum that is 1 everywhere, so that grey spectra become grey colours. Colours outside of the gamut
/// are cut at 0. A single sample stands for a constant.
Rgb rgb_of_spectrum(const std::vector<glm::vec2>& samples);

/// Linear sRGB of the radiance of a black body, W / (m^2 sr nm) weighted by the CIE's curves, as Mitsuba has it;
/// kelvin > 0. White is D65.
Rgb rgb_of_black_body(double kelvin);

} // namespace tessera
