// BSDFs that transmit light without refraction.
#pragma once

#include "render/surface/scattering.h"

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Lambertian transmission from either side, without reflection; Mitsuba 0.6's `difftrans`.
struct DiffuseTransmitter {
    Rgb transmittance{0};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const { return 1; }
    Rgb albedo(glm::vec3) const { return transmittance; }
};

/// A flat layer of a medium with single scattering [Hanrahan 1993], symmetric and without visible boundaries;
/// Mitsuba 0.6's `hk`.
struct MediumLayer {
    Rgb scattered{0};     ///< single-scattering albedo
    Rgb depth{0};         ///< optical thickness at normal incidence
    float g = 0;          ///< mean cosine of the phase function [Henyey 1941], in (-1, 1)
    bool is_clear = true; ///< whether unscattered light is transmitted

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    /// Returns 1 for isotropic scattering, less for directional scattering, and 0 without scattering.
    float roughness() const;
    Rgb albedo(glm::vec3) const { return Rgb(1); }

private:
    /// Returns the fraction of unscattered light for a direction with this cosine.
    Rgb unscattered(float cosine) const;
};

} // namespace tessera
