#pragma once

#include "render/session/snapshot.h"
#include "ui/canvas.h"

#include <memory>
#include <string>
#include <string_view>

namespace tessera {

/// What a pane can show of a snapshot.
enum class Buffer { reconstruction, primal, dx, dy, reused, failed };
inline constexpr Buffer all_buffers[] = {Buffer::reconstruction, Buffer::primal, Buffer::dx, Buffer::dy,
                                         Buffer::reused,         Buffer::failed};

std::string_view short_name(Buffer buffer); ///< "reconstruction", ...: names of log and command line
std::string_view long_name(Buffer buffer);  ///< "Reconstruction", ...: names of the panel
ColourMap colour_map(Buffer buffer);

/// A method's name as papers write it: "PT", "PR", "G-PT", "G-PR".
std::string_view paper_name(Method method);

/// What the buffer's image is made from: changes exactly when another picture is to be shown. Null: there is none.
std::shared_ptr<const void> picture_source(const Snapshot& snapshot, Buffer buffer);

/// The buffer's image; empty if the snapshot has none. Where there is no reconstruction (yet) of the snapshot's
/// size, or none is needed, the primal stands in, which holds the very direct light, so that lamps are not black.
/// `scratch` is storage to build an image in; the result may refer to it or to the snapshot.
const RgbImage& picture(const Snapshot& snapshot, Buffer buffer, RgbImage& scratch);

/// The value that the last false colour stands for in such a buffer's image: 1 for shares, else the greatest,
/// rounded up to one that reads well. 1 for an image without any value above 0.
float top_value(Buffer buffer, const RgbImage& image);

/// What false colours up to `top` stand for: "reused: 0 .. 50 paths a pass".
std::string legend_text(Buffer buffer, float top);

} // namespace tessera
