#pragma once

#include "recon/image.h"
#include "render/scene/texture.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Unit of all radiances here: W / (m^2 sr nm), averaged over wavelengths with the CIE's y as weight, so that
/// luminance(rgb) times this is in cd/m^2: 683 lm/W times 106.857 nm, the integral of y. The emitters `sky`, `sun`
/// and `sunsky` of Mitsuba 0.6 (RGB) and of Mitsuba 3 have the same unit.
inline constexpr float candela_per_radiance = 683.0f * 106.856980f;

/// What a Preetham sky is to be scaled by to come near the brightness of the sky of [Hosek 2012], which both
/// Mitsubas have. Preetham's is the brighter one: the light falling on the ground is 1.45 to 2.1 times as much for
/// turbidities of 2 to 6 with the sun 25 to 70 degrees high; this is the middle of it, and the rest depends on
/// both.
inline constexpr float hosek_level = 0.6f;

struct SkySettings {
    glm::vec3 sun_direction{0, 1, 0}; ///< unit, toward the sun, where +y is up; one below the horizon is put on it
    float turbidity = 3;              ///< [1, 10]; below 2 the formulas fail, and 2 is taken
    float stretch = 1;                ///< [1, 2]: zenith angles are divided by it, 2 fills the whole sphere
    bool extend = false;              ///< below the horizon: its colour, fading out downward, in place of black
    Rgb scale{1};                     ///< factor on the radiance
};

/// Daylight of a clear sky, without the sun's disk [Preetham 1999]; made by make_sky().
struct Sky {
    /// Coefficients A to E of the distribution [Perez 1993], [Preetham 1999, eq. 3], one each for Y, x and y.
    struct Perez {
        glm::vec3 a, b, c, d, e;
    };
    SkySettings settings;
    Perez perez;
    glm::vec3 zenith; ///< Y in kcd/m^2, x, y, each divided by the distribution at the zenith
};

Sky make_sky(const SkySettings& settings);

/// Radiance of the sky in a unit direction, where +y is up. Never negative: what lies outside sRGB is clamped.
Rgb sky_radiance(const Sky& sky, glm::vec3 direction);

/// The sky as an environment map of `width` times `width / 2` pixels, as EnvironmentMap has it: pixels hold the
/// radiance at their places. `width` is at least 4.
Bitmap sky_bitmap(const Sky& sky, int width);

} // namespace tessera
