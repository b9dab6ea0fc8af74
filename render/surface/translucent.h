// What sends light through to the other side without bending it.
#pragma once

#include "render/surface/scattering.h"

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Lambert's law for what goes through, from either side; nothing is reflected. Mitsuba 0.6's `difftrans`.
struct DiffuseTransmitter {
    Rgb transmittance{0};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const { return 1; }
    Rgb albedo(glm::vec3) const { return transmittance; }
};

/// A flat layer of a medium, in which light is scattered once or not at all [Hanrahan 1993], alike from both
/// sides; its boundaries are not seen. Mitsuba 0.6's `hk`.
struct MediumLayer {
    Rgb scattered{0};     ///< share of the light that meets a particle that is scattered
    Rgb depth{0};         ///< optical, straight through
    float g = 0;          ///< mean cosine of scattering [Henyey 1941], in (-1, 1)
    bool is_clear = true; ///< whether light that meets nothing goes on

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    /// 1 where light is scattered to all sides, and less the more it goes one way.
    float roughness() const;
    Rgb albedo(glm::vec3) const { return Rgb(1); }

private:
    /// Share of light along a direction that meets nothing.
    Rgb unscattered(float cosine) const;
};

} // namespace tessera
