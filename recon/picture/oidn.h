#pragma once

#include "recon/image.h"
#include "recon/norm.h"

#include <cstdint>
#include <string>

namespace tessera {

// Intel Open Image Denoise [Afra 2019-2026], the denoiser that most would take: the rival. It is no part of this
// program and not needed to build it. Its library is looked for at run time, once: in the file or folder (or below
// it) that the environment variable TESSERA_OIDN names; without it where the system has libraries, then in the
// packages of the active Python environment (VIRTUAL_ENV), whose wheels hold it. Versions 1.4 and 2 will do.

/// Why the denoiser cannot be used, and how to get it; empty: it can.
const std::string& oidn_problem();

/// The norm, or guided in place of oidn where the denoiser cannot be used.
Norm possible(Norm norm);

/// What the denoiser makes of radiance without very direct light, by the features' albedo and normals; empty
/// features: by the picture alone. In the calling thread. Throws std::runtime_error with oidn_problem() or what
/// the library says.
RgbImage denoised_by_oidn(const RgbImage& image, const FeatureImages& features);

/// About the memory that it takes, as measured with version 2.5.
std::uint64_t bytes_of_oidn(int width, int height);

} // namespace tessera
