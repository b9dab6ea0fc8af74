#pragma once

#include "render/session/snapshot.h"
#include "ui/picture_frame.h"
#include "ui/screen_rect.h"

#include <optional>

namespace tessera {

/// Draws over a picture which pixels share their light in the snapshot's newest pass: the grid of tiles, what they
/// are cut into, and about one place the whole sampling set with its border. To be called within the pane's
/// window.
/// @param clip  the part of the screen to draw on
/// @param place fractions of the image; empty: no set is marked
void draw_tiles(const PictureFrame& frame, const ScreenRect& clip, const Snapshot& snapshot,
                std::optional<glm::vec2> place);

} // namespace tessera
