#pragma once

#include "recon/image.h"

#include <string>
#include <string_view>

namespace tessera {

/// Text as HTML and XML have it: <, >, & and quotes by their names, control characters as spaces.
std::string escaped(std::string_view text);

/// <img> of the image as PNG, times 2^exposure, in the page itself. `attributes` are as HTML has them.
std::string inline_image(const RgbImage& image, float exposure, std::string_view attributes);

} // namespace tessera
