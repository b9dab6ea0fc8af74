#pragma once

#include "recon/image.h"
#include "render/scene/camera.h"
#include "render/surface/texture.h"

#include <optional>

#include <glm/vec3.hpp>

namespace tessera {

/// A picture that a point light projects into the field of view of a perspective camera at the light. There is no
/// light outside the picture.
struct Slide {
    enum class Kind {
        share,     ///< spot: a square picture, a factor on the intensity
        irradiance ///< projector, in the bitmap's proportions; irradiance at distance 1 is pi times the picture
    };
    Texture picture{Rgb(1)};
    Camera camera; ///< orientation and field of view; unscaled
    Kind kind = Kind::share;

    /// Returns the factor on the intensity toward a unit direction.
    Rgb toward(glm::vec3 direction) const;

    /// Returns the integral of toward() over all directions, for Kind::irradiance.
    Rgb flux() const;

private:
    glm::ivec2 size() const; // in pixels; only its proportions matter
};

/// A point light: isotropic, limited to a cone, or projecting a slide.
struct PointLight {
    glm::vec3 position{0};
    Rgb intensity{1};        ///< power per solid angle
    glm::vec3 axis{0, 0, 1}; ///< of the cone, unit
    float cutoff = 180;      ///< degrees from the axis; no light beyond; 180: no cone
    float beam_width = 180;  ///< degrees from the axis with full intensity; linear falloff up to `cutoff`
    std::optional<Slide> slide{};

    /// Returns the intensity toward a unit direction.
    Rgb toward(glm::vec3 direction) const;
    /// Returns the approximate integral of the intensity's luminance over all directions.
    double power() const;
};

} // namespace tessera
