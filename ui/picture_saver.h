#pragma once

#include "ui/viewer.h"

namespace tessera {

/// Saves what can be seen: fulfils the wish to save the window's picture, some frames after it came up, when the
/// menu that it came from is closed.
class PictureSaver {
public:
    /// To be called after each frame, while it is bound for reading. `pixels`: of its framebuffer. True: another
    /// frame is due.
    bool after_frame(Viewer& viewer, glm::ivec2 pixels);

private:
    int age_ = 0; // frames since the wish
};

} // namespace tessera
