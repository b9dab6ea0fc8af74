// Pixels of one part of an OpenEXR file.
#pragma once

#include "render/io/exr.h"
#include "render/io/exr_color.h"
#include "render/io/exr_layers.h"

#include <cstddef>
#include <vector>

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

namespace tessera {

/// Returns the primaries in a header, or those of Rec. 709 if there are none.
Chromaticities primaries_of(const Imf::Header& header);

/// Reads layers of a part, in the order of `names`. Colours get the primaries of Rec. 709. Polls `watch`. Throws
/// std::runtime_error, also for too little memory and once `watch` returns false.
/// @param part  index; all layers of `names` are in it
std::vector<ExrLayer> read_part(Imf::MultiPartInputFile& input, std::size_t part,
                                const std::vector<ExrLayerNames>& names, const ReadProgress& watch);

} // namespace tessera
