#pragma once

#include "ui/controls.h"
#include "ui/showing.h"

#include <string>

namespace tessera {

/// The line below a picture: method, samples a pixel, seconds, rays a second, reconstruction.
std::string status_text(const PaneState& pane, bool paused, const Pace& pace);

/// A buffer's number: "0.123 0.456 0.789  Y 0.4", "12.5 paths a pass".
std::string value_text(const Rgb& value, ColourMap map, const BufferInfo& about);

/// Pixel and number at the cursor in what the pane shows; empty where there is none.
std::string cursor_text(const ViewerState& state, const PaneImages& images, int pane);

/// Draws both in a line: the status gives way.
void draw_status(const std::string& id, int pane, const ViewerState& state, const PaneImages& images,
                 Controls& controls);

} // namespace tessera
