#pragma once

#include "recon/image.h"

#include <functional>
#include <string_view>

namespace tessera {

/// Whether the bytes begin as a Radiance picture (.hdr, .pic) does.
bool is_radiance(std::string_view bytes);

/// Reads a Radiance picture: RGBE, rows from the top to the bottom, plain or run-length encoded [Ward, "Real
/// Pixels", Graphics Gems II, 1991]. Throws std::runtime_error that says what is wrong with it, also where
/// `wanted`, asked at each row, wants it no more.
RgbImage parse_radiance(std::string_view bytes, const std::function<bool()>& wanted);

} // namespace tessera
