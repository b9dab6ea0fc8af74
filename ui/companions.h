#pragma once

#include "render/session/first_hits.h"

#include <memory>
#include <string>

namespace tessera {

/// The image that errors are measured against.
struct Reference {
    std::string name; ///< of its file
    RgbImage image;
    float mean = 0; ///< of its luminance
};

/// What some buffers are made of beside a pane's snapshot; null: there is none.
struct Companions {
    std::shared_ptr<const Reference> reference;
    std::shared_ptr<const FirstHits> first_hits; ///< of the camera and size that the panes show
};

} // namespace tessera
