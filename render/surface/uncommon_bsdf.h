#pragma once

#include "render/surface/layered.h"
#include "render/surface/principled.h"
#include "render/surface/scattering.h"
#include "render/surface/translucent.h"
#include "render/surface/ward.h"

#include <optional>
#include <string_view>
#include <variant>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Returns Bsdf::relative_index() of one kind; 1 for kinds without it.
template <class Kind>
float relative_index_of(const Kind& kind, glm::vec3 to_previous) {
    if constexpr (requires { kind.relative_index(to_previous); })
        return kind.relative_index(to_previous);
    else
        return 1;
}

/// Expensive or rare kinds of BSDF, grouped into one alternative of Bsdf::kind. libstdc++ visits up to 11
/// alternatives with a switch and more through a function table, which would slow all kinds down. Kinds too large
/// for a Bsdf hold a pointer to their material and look up its textures in every call.
struct UncommonBsdf {
    std::variant<Mixture, Coated, Principled, ThinPrincipled, Ward, DiffuseTransmitter, MediumLayer> kind;

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const;
    Rgb albedo(glm::vec3 to_previous) const;
    float relative_index(glm::vec3 to_previous) const;
};

} // namespace tessera
