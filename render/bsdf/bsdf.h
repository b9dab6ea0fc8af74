#pragma once

#include "render/bsdf/conductor.h"
#include "render/bsdf/dielectric.h"
#include "render/bsdf/diffuse.h"
#include "render/bsdf/plastic.h"
#include "render/bsdf/scattering.h"

#include <optional>
#include <variant>

namespace tessera {

/// What a surface does to light at one point, as plain numbers. Every alternative has
///   evaluate(to_previous, to_next)        the non-delta part: f cos and pdf_w
///   sample(to_previous, lobe, u)          a direction of any part; empty: light ends here
///   evaluate_delta(to_previous, scatter)  the delta part of that kind: direction, value and probability
///   roughness()                           of the roughest non-delta part, 1 for diffuse; 0: there is none
/// Directions are unit, in the shading frame, and point away from the surface. Values hold for radiance that
/// arrives along to_next and leaves along to_previous.
struct Bsdf {
    std::variant<Diffuse, RoughConductor, SmoothConductor, SmoothDielectric, ThinDielectric, Plastic> kind =
        Diffuse{};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
        return std::visit([&](const auto& b) { return b.evaluate(to_previous, to_next); }, kind);
    }
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
        return std::visit([&](const auto& b) { return b.sample(to_previous, lobe, u); }, kind);
    }
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const {
        return std::visit([&](const auto& b) { return b.evaluate_delta(to_previous, scatter); }, kind);
    }
    float roughness() const {
        return std::visit([](const auto& b) { return b.roughness(); }, kind);
    }
};

} // namespace tessera
