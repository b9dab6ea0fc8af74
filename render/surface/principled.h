#pragma once

#include "render/surface/scattering.h"
#include "render/surface/texture.h"

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

struct PrincipledMaterial;
struct ThinPrincipledMaterial;

/// Disney's principled BSDF [Burley 2012, Burley 2015] as in Mitsuba 3: a blend of a diffuse, a metallic and a
/// rough glass base under sheen and a clear coat. Black from below if it does not transmit light.
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

/// Disney's principled BSDF for a sheet without thickness [Burley 2015, 5.3]. Both sides are alike, and
/// transmitted light is scattered but not refracted.
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
