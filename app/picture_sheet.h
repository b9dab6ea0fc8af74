#pragma once

#include "recon/image.h"

#include <string>
#include <vector>

namespace tessera {

struct LabelledPicture {
    std::string label;
    RgbImage image;
};

/// The pictures row by row, each below its label; what of a label is wider than its picture runs into the next.
/// All must be of one size; there must be one.
RgbImage picture_sheet(const std::vector<LabelledPicture>& pictures, int columns);

} // namespace tessera
