#pragma once

#include "ui/controls.h"
#include "ui/inspector.h"

namespace tessera {

/// The vertices of the base path, or of the shift whose row is chosen; `width` in screen units.
void draw_vertex_table(const Inspector& inspector, float width, Controls& controls);

/// The shifts on show, a row each. The one under the mouse is marked, a click chooses.
void draw_shift_table(Inspector& inspector, float width, Controls& controls);

/// Radiance as a luminance, and numbers, in four digits.
std::string short_text(const Rgb& value);
std::string short_text(float value);
/// "12, 34".
std::string short_text(glm::ivec2 pixel);

} // namespace tessera
