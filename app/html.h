#pragma once

#include "recon/image.h"
#include "ui/xml_text.h"

#include <string>
#include <string_view>

namespace tessera {

/// <img> of the image as PNG, times 2^exposure, in the page itself. `attributes` are as HTML has them.
std::string inline_image(const RgbImage& image, float exposure, std::string_view attributes);

} // namespace tessera
