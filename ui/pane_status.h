#pragma once

#include "ui/controls.h"
#include "ui/showing.h"

#include <string>

namespace tessera {

/// The line below a picture: method, why it rests, samples a pixel, seconds, rays a second, reconstruction
/// with its solver's steps and time, or one that is under way for long.
std::string status_text(const ViewerState& state, int pane);

/// "waiting for pane 2 (3:10 of 10:00)": another pane catches up with what this one has had. Empty: it does not
/// wait.
std::string waiting_text(const ViewerState& state, int pane);

/// A buffer's number: "0.123 0.456 0.789  Y 0.4", "12.5 paths a pass".
std::string value_text(const Rgb& value, ColourMap map, const BufferInfo& about);

/// Pixel and number at the cursor in what the pane shows; empty where there is none. Of a first look, too, the
/// pixel is one of the size that is asked for.
std::string cursor_text(const ViewerState& state, const PaneImages& images, int pane);
/// What these numbers are, and their unit.
std::string cursor_help(const Showing& showing, const ViewerState& state);

/// Draws both in a line: the status gives way.
void draw_status(const std::string& id, int pane, const ViewerState& state, const PaneImages& images,
                 Controls& controls);

} // namespace tessera
