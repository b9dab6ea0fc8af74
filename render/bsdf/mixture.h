#pragma once

#include "render/bsdf/scattering.h"
#include "render/scene/texture.h"

#include <optional>

namespace tessera {

struct MixtureMaterial;

/// A weighted sum of BSDFs. Unlike the others it looks its parts up whenever it is asked, so that a Bsdf stays
/// small and only scenes with mixtures pay. Parts that transmit without scattering share one direction.
struct Mixture {
    const MixtureMaterial* material = nullptr; ///< outlives this
    SurfacePoint at{};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const;
    float relative_index(glm::vec3 to_previous) const;
};

} // namespace tessera
