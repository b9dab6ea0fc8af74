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

/// What Bsdf::relative_index() says of one kind.
template <class Kind>
float relative_index_of(const Kind& kind, glm::vec3 to_previous) {
    if constexpr (requires { kind.relative_index(to_previous); })
        return kind.relative_index(to_previous);
    else
        return 1;
}

/// The kinds of BSDF that take long anyhow, or that few scenes have, as one alternative of Bsdf::kind: libstdc++
/// visits up to 11 by a switch, and more through a table of pointers, for which all kinds would pay. What needs
/// more numbers than a Bsdf has room for looks them up in its material whenever it is asked.
struct FurtherKinds {
    std::variant<Mixture, Coated, Principled, ThinPrincipled, Ward, DiffuseTransmitter, MediumLayer> kind;

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const;
    Rgb albedo(glm::vec3 to_previous) const;
    float relative_index(glm::vec3 to_previous) const;
};

} // namespace tessera
