#pragma once

#include "render/surface/scattering.h"
#include "render/surface/texture.h"

#include <optional>

namespace tessera {

struct CoatedMaterial;

/// A BSDF under a smooth, perhaps absorbing, dielectric layer [Weidlich 2007], as Mitsuba's `coating`: light that
/// is sent back from the inside of the layer is lost. The upper side only. Looks its base up whenever it is asked,
/// as a Mixture does.
struct Coated {
    const CoatedMaterial* material = nullptr; ///< outlives this; its base transmits nothing
    SurfacePoint at{};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const;
    Rgb albedo(glm::vec3 to_previous) const;
};

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
    Rgb albedo(glm::vec3 to_previous) const;
    float relative_index(glm::vec3 to_previous) const;
};

} // namespace tessera
