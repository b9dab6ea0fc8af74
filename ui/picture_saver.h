#pragma once

#include "ui/viewer.h"

namespace tessera {

/// Saves what can be seen: fulfils the wishes to save the picture and the charts, some frames after they came up,
/// when the menu that they came from is closed and what is to be seen is measured and laid out.
class PictureSaver {
public:
    /// To be called after each frame, while it is bound for reading. `pixels`: of its framebuffer. True: another
    /// frame is due.
    bool after_frame(Viewer& viewer, glm::ivec2 pixels);

private:
    int age_ = 0; // frames since the wish
};

} // namespace tessera
