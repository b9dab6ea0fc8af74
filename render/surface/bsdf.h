#pragma once

#include "render/surface/diffuse.h"
#include "render/surface/interfaces.h"
#include "render/surface/plastic.h"
#include "render/surface/scattering.h"
#include "render/surface/uncommon_bsdf.h"

#include <optional>
#include <string_view>
#include <type_traits>
#include <variant>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace tessera {

/// The BSDF at a surface point. Every alternative of `kind` has
///   evaluate(to_previous, to_next)        the non-delta part: f cos and pdf_w
///   sample(to_previous, lobe, u)          a direction of any part; empty: the path ends
///   evaluate_delta(to_previous, scatter)  the delta part of that kind: direction, value and probability
///   roughness()                           alpha of the roughest non-delta part; 1: diffuse; 0: none
///   albedo(to_previous)                   approximate directional albedo in closed form; 1 for mirrors and glass
/// Directions are unit, in the shading frame, and point away from the surface. Values apply to radiance that
/// arrives along to_next and leaves along to_previous.
struct Bsdf {
    std::variant<Diffuse, RoughDiffuse, RoughConductor, SmoothConductor, SmoothDielectric, RoughDielectric,
                 ThinDielectric, Plastic, Phong, UncommonBsdf>
        kind = Diffuse{};

    /// Normal before a bump or normal map bent the frame, in the frame. A direction above one surface and below
    /// the other is rejected to prevent light leaks.
    glm::vec3 interpolated_normal{0, 0, 1};
    /// Squared roughness of the shadowing term that softens the bump terminator [Estevez 2019]. 0: no softening;
    /// negative: the frame is not bent.
    float terminator = -1;
    bool has_relief() const { return terminator >= 0; }
    /// Whether a relief that to_previous sees from behind is turned by a half turn about interpolated_normal, so
    /// that the bent normal faces to_previous, as with Mitsuba's `flip_invalid_normals`. Otherwise it is black.
    bool turns_relief = false;

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
        if (has_relief()) [[unlikely]]
            return evaluate_bent(to_previous, to_next);
        return std::visit([&](const auto& b) { return b.evaluate(to_previous, to_next); }, kind);
    }
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
        if (has_relief()) [[unlikely]]
            return sample_bent(to_previous, lobe, u);
        return std::visit([&](const auto& b) { return b.sample(to_previous, lobe, u); }, kind);
    }
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const {
        if (has_relief()) [[unlikely]]
            return evaluate_delta_bent(to_previous, scatter);
        return std::visit([&](const auto& b) { return b.evaluate_delta(to_previous, scatter); }, kind);
    }
    float roughness() const {
        return std::visit([](const auto& b) { return b.roughness(); }, kind);
    }

    /// Returns whether the BSDF is a single delta reflection.
    bool is_mirror() const { return std::holds_alternative<SmoothConductor>(kind); }

    /// Returns the approximate directional albedo, at least 0.01 per channel so that radiance can be divided by
    /// it.
    Rgb albedo(glm::vec3 to_previous) const {
        if (is_turned(to_previous)) [[unlikely]]
            to_previous = half_turn(to_previous);
        return glm::max(std::visit([&](const auto& b) { return b.albedo(to_previous); }, kind), Rgb(0.01f));
    }

    /// Returns eta of theory (15) for transmission: the index of refraction on the far side over that on the
    /// side of to_previous. Transmitted radiance is divided by its square. 1: light passes without bending.
    float relative_index(glm::vec3 to_previous) const {
        return std::visit([&](const auto& b) { return relative_index_of(b, to_previous); }, kind);
    }

private:
    bool is_cut(glm::vec3 to_previous, glm::vec3 to_next) const {
        return to_previous.z * glm::dot(interpolated_normal, to_previous) <= 0 ||
               to_next.z * glm::dot(interpolated_normal, to_next) <= 0;
    }
    /// Returns whether directions must be turned by half_turn(), instead of the relief.
    bool is_turned(glm::vec3 to_previous) const {
        return turns_relief && has_relief() && to_previous.z * glm::dot(interpolated_normal, to_previous) < 0;
    }
    glm::vec3 half_turn(glm::vec3 v) const {
        return 2 * glm::dot(interpolated_normal, v) * interpolated_normal - v;
    }
    float shadowing(glm::vec3 to_next) const;
    BsdfValue evaluate_bent(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample_bent(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta_bent(glm::vec3 to_previous, Scatter scatter) const;
};

/// Returns the kind of a BSDF as named in scene files, such as "diffuse" or "roughconductor".
std::string_view kind_name(const Bsdf& bsdf);

// Every path vertex holds a Bsdf, so it stays small and trivially copyable.
static_assert(std::is_trivially_copyable_v<Bsdf>);
static_assert(sizeof(Bsdf) <= sizeof(std::variant<Plastic>) + 24);

} // namespace tessera
