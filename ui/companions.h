#pragma once

#include "render/scene/scene_checksums.h"
#include "render/session/first_hits.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace tessera {

/// The image that errors are measured against.
struct Reference {
    std::string name; ///< of its file
    RgbImage image;
    float mean = 0; ///< of its luminance
    /// Two renders that are independent of each other, whose mean is the image: errors against both are free of
    /// the reference's own (recon/metrics.h). Empty: it has none, and how noisy it is is not known.
    std::array<RgbImage, 2> halves{};
    std::size_t not_finite = 0;            ///< pixels that errors cannot be measured at
    std::optional<SceneChecksums> scene{}; ///< what it shows; empty: its file does not say
};

/// What some buffers are made of beside a pane's snapshot; null: there is none.
struct Companions {
    std::shared_ptr<const Reference> reference;
    std::shared_ptr<const FirstHits> first_hits; ///< of the camera and size that the panes show, ...
    bool first_hits_are_earlier = false;         ///< ... or showed before: newer ones are on their way
};

} // namespace tessera
