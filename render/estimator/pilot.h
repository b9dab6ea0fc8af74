#pragma once

#include "render/estimator/pass.h"
#include "render/estimator/worker.h"

#include <array>

namespace tessera {

/// Pilot pass: measures the gain of path reuse for G-PR before the first pass. It takes two samples of sets of 3
/// x 3 pixels, one set per 32 pixels. Differences of the two samples contain noise only, and no gradients of the
/// picture. It costs about as much as one sample of path tracing.
class Pilot {
public:
    /// Keeps references, as Pass does. Uses the tiles of `learned` only.
    Pilot(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
          const LearnedReuse& learned);

    /// Returns the statistics of one cell.
    CellStatistics explore(PixelRect cell, Worker& worker) const;

private:
    /// Settings with other seeds: both samples are independent of each other and of all passes.
    std::array<RenderSettings, 2> settings_;
    Pass first_, second_;
};

} // namespace tessera
