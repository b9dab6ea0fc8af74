#pragma once

#include "ui/buffer.h"
#include "ui/panels.h"

#include <string>

namespace tessera {

/// What a map's false colours stand for, in words and colours, in the lower left corner of a picture if there is
/// room. `top` as in CanvasView; noted as `id`. To be called right after the item that the picture is.
void draw_legend(const ScreenRect& picture, const std::string& id, Buffer buffer, float top, Controls& controls);

} // namespace tessera
