#pragma once

#include "ui/buffer.h"
#include "ui/controls.h"
#include "ui/screen_rect.h"

#include <string>

namespace tessera {

/// What a map's false colours stand for, in words and colours, in a lower corner of a picture if there is room:
/// the left one, or the right. Noted as `id`. To be called after the item that the picture is. Returns the bar of
/// colours, which is empty if nothing was drawn.
ScreenRect draw_legend(const ScreenRect& picture, const std::string& id, Buffer buffer, const ValueRange& range,
                       bool at_right, Controls& controls);

} // namespace tessera
