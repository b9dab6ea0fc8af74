#pragma once

#include "recon/image.h"
#include "recon/norm.h"

#include <cstdint>
#include <string>

namespace tessera {

// Intel Open Image Denoise [Afra 2019-2026], as a comparison. It is not part of this program and not needed to
// build it. Its library (version 1.4 or 2) is searched once, at run time. The environment variable TESSERA_OIDN
// names its file or a folder that holds it. Without that variable, the system's libraries and the packages of the
// active Python environment (VIRTUAL_ENV) are searched.

/// Returns why the denoiser cannot be used, and how to get it; empty: it can be used.
const std::string& oidn_problem();

/// Returns the norm, or guided in place of oidn if the denoiser cannot be used.
Norm possible(Norm norm);

/// Denoises radiance without directly visible emission, with albedo and normal of the features; empty features:
/// without them. Runs in the calling thread. Throws std::runtime_error with oidn_problem() or the library's
/// message.
RgbImage denoised_by_oidn(const RgbImage& image, const FeatureImages& features);

/// Returns about the bytes that the library takes; measured for version 2.5.
std::uint64_t bytes_of_oidn(int width, int height);

} // namespace tessera
