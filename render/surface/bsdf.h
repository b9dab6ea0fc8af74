#pragma once

#include "render/surface/diffuse.h"
#include "render/surface/further_kinds.h"
#include "render/surface/interfaces.h"
#include "render/surface/plastic.h"
#include "render/surface/scattering.h"

#include <optional>
#include <string_view>
#include <type_traits>
#include <variant>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace tessera {

/// What a surface does to light at one point, as plain numbers. Every alternative has
///   evaluate(to_previous, to_next)        the non-delta part: f cos and pdf_w
///   sample(to_previous, lobe, u)          a direction of any part; empty: light ends here
///   evaluate_delta(to_previous, scatter)  the delta part of that kind: direction, value and probability
///   roughness()                           of the roughest non-delta part, 1 for diffuse; 0: there is none
///   albedo(to_previous)                   about the share of light from everywhere that leaves along to_previous,
///                                         by a closed form; 1 for what only reflects and refracts as glass does
/// Directions are unit, in the shading frame, and point away from the surface. Values hold for radiance that
/// arrives along to_next and leaves along to_previous.
struct Bsdf {
    std::variant<Diffuse, RoughDiffuse, RoughConductor, SmoothConductor, SmoothDielectric, RoughDielectric,
                 ThinDielectric, Plastic, Phong, FurtherKinds>
        kind = Diffuse{};

    /// The normal before relief bent the frame, in the frame. What is above the one surface and below the other is
    /// cut off, or light would leak through.
    glm::vec3 unbent_normal{0, 0, 1};
    /// How much light is lost as it gets steep to the unbent normal, where else its shadow would have a sharp edge
    /// [Estevez 2019]: the square of the roughness in that formula. 0: none is. Negative: the frame is not bent.
    float terminator = -1;
    bool is_bent() const { return terminator >= 0; }

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
        BsdfValue v = std::visit([&](const auto& b) { return b.evaluate(to_previous, to_next); }, kind);
        if (is_bent()) [[unlikely]]
            v = is_cut(to_previous, to_next) ? BsdfValue{} : BsdfValue{v.f_cos * shadowing(to_next), v.pdf_w};
        return v;
    }
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
        if (is_bent()) [[unlikely]]
            return sample_bent(to_previous, lobe, u);
        return std::visit([&](const auto& b) { return b.sample(to_previous, lobe, u); }, kind);
    }
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const {
        DeltaValue v = std::visit([&](const auto& b) { return b.evaluate_delta(to_previous, scatter); }, kind);
        if (is_bent())
            v = is_cut(to_previous, v.to_next)
                    ? DeltaValue{}
                    : DeltaValue{v.to_next, v.value * shadowing(v.to_next), v.probability};
        return v;
    }
    float roughness() const {
        return std::visit([](const auto& b) { return b.roughness(); }, kind);
    }

    /// Whether it sends all light that arrives one way: what is seen in it is as sharp as what is seen directly.
    bool is_mirror() const { return std::holds_alternative<SmoothConductor>(kind); }

    /// About the directional albedo. Never below a hundredth in any channel, so that light can be divided by it.
    Rgb albedo(glm::vec3 to_previous) const {
        return glm::max(std::visit([&](const auto& b) { return b.albedo(to_previous); }, kind), Rgb(0.01f));
    }

    /// Where light goes through the surface: index on the far side over that on the side of to_previous, by which
    /// such scatters have their half vector, and by whose square radiance is divided. 1: nothing is bent.
    float relative_index(glm::vec3 to_previous) const {
        return std::visit([&](const auto& b) { return relative_index_of(b, to_previous); }, kind);
    }

private:
    bool is_cut(glm::vec3 to_previous, glm::vec3 to_next) const {
        return to_previous.z * glm::dot(unbent_normal, to_previous) <= 0 ||
               to_next.z * glm::dot(unbent_normal, to_next) <= 0;
    }
    float shadowing(glm::vec3 to_next) const;
    std::optional<BsdfSample> sample_bent(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
};

/// What kind of BSDF it is, in the words of scene files, such as "diffuse" or "roughconductor".
std::string_view kind_name(const Bsdf& bsdf);

// Paths are made of these: plain numbers, and no more of them than a plastic takes.
static_assert(std::is_trivially_copyable_v<Bsdf>);
static_assert(sizeof(Bsdf) <= sizeof(std::variant<Plastic>) + 16);

} // namespace tessera
