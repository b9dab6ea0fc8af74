#pragma once

#include "render/surface/scattering.h"
#include "render/surface/texture.h"

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

struct PrincipledMaterial;
struct ThinPrincipledMaterial;

/// Disney's principled BSDF [Burley 2012, Burley 2015] as Mitsuba 3 reads it: a base that is diffuse, metal, rough
/// glass, or anything between, under sheen and a clear coat. Black from below where it transmits nothing.
struct Principled {
    const PrincipledMaterial* material = nullptr; ///< outlives this
    SurfacePoint at{};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const;
    Rgb albedo(glm::vec3 to_previous) const;
    float relative_index(glm::vec3 to_previous) const;
};

/// The same for a sheet without thickness [Burley 2015, 5.3]: it looks the same from both sides, and what goes
/// through is scattered, not bent.
struct ThinPrincipled {
    const ThinPrincipledMaterial* material = nullptr; ///< outlives this
    SurfacePoint at{};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const;
    Rgb albedo(glm::vec3 to_previous) const;
};

} // namespace tessera
