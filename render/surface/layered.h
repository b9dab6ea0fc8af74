#pragma once

#include "render/surface/scattering.h"
#include "render/surface/texture.h"

#include <optional>

namespace tessera {

struct CoatedMaterial;

/// A BSDF under a smooth, possibly absorbing dielectric layer [Weidlich 2007], as Mitsuba's `coating`, on the
/// upper side only. Light that the layer reflects internally is lost. Every call resolves the base, as in
/// Mixture.
struct Coated {
    const CoatedMaterial* material = nullptr; ///< outlives this; its base is opaque
    SurfacePoint at{};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const;
    Rgb albedo(glm::vec3 to_previous) const;
};

struct MixtureMaterial;

/// A weighted sum of BSDFs. Its components are resolved in every call, so that a Bsdf stays small. Delta
/// components of the same kind of scattering must have the same direction.
struct Mixture {
    const MixtureMaterial* material = nullptr; ///< outlives this
    SurfacePoint at{};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const;
    Rgb albedo(glm::vec3 to_previous) const;
    float relative_index(glm::vec3 to_previous) const;
};

} // namespace tessera
