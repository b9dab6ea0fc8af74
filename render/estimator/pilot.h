#pragma once

#include "render/estimator/pass.h"

#include <array>

namespace tessera {

/// Tries before the first pass what sharing would bring G-PR. It takes two samples, so that their differences are
/// noise and nothing of the picture, of sets of 3 x 3 pixels: of one in 32 pixels. That costs about as much as a
/// sample of path tracing.
class Pilot {
public:
    /// Keeps references, as Pass does; of the plan nothing is asked but its tiles.
    Pilot(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
          const ReusePlan& plan);

    /// What one cell of a plan is like.
    PlanEvidence explore(PixelRect cell, Worker& worker) const;

private:
    /// With seeds of their own, so that nothing of the trials is in any pass, nor of one in the other.
    std::array<RenderSettings, 2> settings_;
    Pass first_, second_;
};

} // namespace tessera
