// Daylight: the sky, the sun's disk, and the position of the sun.
#pragma once

#include "recon/image.h"
#include "render/surface/texture.h"

#include <glm/vec3.hpp>

namespace tessera {

/// Luminance in cd/m^2 per unit of radiance in this file. The unit is W / (m^2 sr nm), averaged over wavelengths
/// with the CIE's y as weight: 683 lm/W times the integral of y, 106.857 nm. `sky`, `sun` and `sunsky` of Mitsuba
/// 0.6 (RGB) and Mitsuba 3 use the same unit.
inline constexpr float candela_per_radiance = 683.0f * 106.856980f;

/// Factor that brings a Preetham sky near the brightness of the sky of [Hosek 2012], which both Mitsubas use. The
/// exact ratio depends on turbidity and on the sun's elevation.
inline constexpr float hosek_scale = 0.6f;

struct SkySettings {
    glm::vec3 sun_direction{0, 1, 0}; ///< unit, toward the sun, +y is up; raised to the horizon if below
    float turbidity = 3;              ///< [1, 10]; the formulas fail below 2, so it is clamped to 2
    float stretch = 1;                ///< [1, 2], divides zenith angles; 2 covers the whole sphere
    bool extend = false;              ///< below the horizon: its colour, fading downward, instead of black
    Rgb scale{1};                     ///< factor on the radiance
};

/// A clear sky without the sun's disk [Preetham 1999]; made by make_sky().
struct Sky {
    /// Coefficients A to E of the distribution [Perez 1993; Preetham 1999, eq. 3], each for Y, x and y.
    struct Perez {
        glm::vec3 a, b, c, d, e;
    };
    SkySettings settings;
    Perez perez;
    glm::vec3 zenith; ///< Y in kcd/m^2, x, y, each divided by the distribution at the zenith
};

Sky make_sky(const SkySettings& settings);

/// Returns the radiance from a unit direction (+y is up); negative components, outside sRGB, are clamped to 0.
Rgb sky_radiance(const Sky& sky, glm::vec3 direction);

/// Samples the sky into a bitmap for an EnvironmentMap, `width` by `width / 2` pixels; `width` is at least 4.
Bitmap sky_bitmap(const Sky& sky, int width);

/// Angular radius of the sun in radians: 0.5358 / 2 degrees, as in Mitsuba.
inline constexpr float sun_angular_radius = 0.2679f * 3.14159265f / 180;

/// Returns the mean radiance of the sun's disk after absorption by the air [Preetham 1999, A.1], as Mitsuba 0.6
/// does; negative components, outside sRGB, are clamped to 0.
/// @param turbidity  in [1, 10]
/// @param elevation  above the horizon, radians, in [0, pi/2]
Rgb sun_radiance(float turbidity, float elevation);

/// Returns the solid angle (sr) of a disk with an angular radius in radians.
float disk_solid_angle(float angular_radius);

/// Returns the radiance of a sun with another angular radius and the same irradiance, as for Mitsuba's
/// sunRadiusScale and sun_aperture. For a radius of 0, use sun_irradiance() with a directional light.
Rgb resized_sun_radiance(Rgb radiance, float angular_radius);

/// Returns the irradiance on a surface facing a sun of radius sun_angular_radius and this radiance.
inline Rgb sun_irradiance(Rgb radiance) {
    return radiance * disk_solid_angle(sun_angular_radius);
}

/// A place and a time; the defaults are those of both Mitsubas: Tokyo, 10 July 2010, 3 pm.
struct PlaceAndTime {
    double latitude = 35.6894;   ///< degrees, north positive
    double longitude = 139.6917; ///< degrees, east positive
    double timezone = 9;         ///< hours by which local time is ahead of UT
    int year = 2010, month = 7, day = 10;
    double hour = 15, minute = 0, second = 0;
};

/// Returns the unit direction toward the sun with +y up, +x east and -z north; y is negative below the horizon.
/// The error is at most half an arc minute for the years 1999 to 2015 [Blanco-Muriel 2001].
glm::vec3 sun_direction(const PlaceAndTime& when);

} // namespace tessera
