#pragma once

#include "recon/image.h"
#include "render/scene/camera.h"
#include "render/surface/texture.h"

#include <optional>

#include <glm/vec3.hpp>

namespace tessera {

/// A picture that a point of light shines through. It falls on what a perspective camera sees that is turned as
/// `camera` is and stands at the light, as that camera's picture; beyond its edges there is no light.
struct Slide {
    enum class Kind {
        share,     ///< a spot's: square, and what the intensity is multiplied by
        irradiance ///< a projector's: as wide and high as its bitmap, and what a plane at distance 1 receives,
                   ///< times pi
    };
    Texture picture{Rgb(1)};
    Camera camera; ///< without a scale
    Kind kind = Kind::share;

    /// Toward a unit direction: what the intensity is multiplied by.
    Rgb toward(glm::vec3 direction) const;

    /// Mean of that over all directions that it falls on, times their solid angle, for Kind::irradiance.
    Rgb flux() const;

private:
    glm::ivec2 size() const; // pixels, for the picture's proportions
};

/// A point that gives off light, in all directions, within a cone, or through a slide.
struct PointLight {
    glm::vec3 position{0};
    Rgb intensity{1};        ///< power per solid angle
    glm::vec3 axis{0, 0, 1}; ///< unit, of the cone
    float cutoff = 180;      ///< degrees from the axis beyond which there is no light; 180: no cone
    float full_within = 180; ///< degrees up to which there is all of it; in between it falls linearly
    std::optional<Slide> slide{};

    /// Intensity toward a unit direction.
    Rgb toward(glm::vec3 direction) const;
    /// About all that it gives off in all directions together: a luminance times solid angle.
    double power() const;
};

} // namespace tessera
