// Daylight: the sky, the sun's disk, and where the sun stands.
#pragma once

#include "recon/image.h"
#include "render/surface/texture.h"

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

/// Half the angle under which the sun's disk is seen, in radians: 0.5358 / 2 degrees, as in Mitsuba.
inline constexpr float sun_angular_radius = 0.2679f * 3.14159265f / 180;

/// Mean radiance of the sun's disk, in the unit of all radiances here, after the air has taken its part [Preetham
/// 1999, A.1]; Mitsuba 0.6 uses the same formulas. `elevation` above the horizon in radians, in [0, pi/2];
/// turbidity in [1, 10]. Never negative: what lies outside sRGB is clamped.
Rgb sun_radiance(float turbidity, float elevation);

/// Solid angle in sr of a disk with this angular radius in radians.
float disk_solid_angle(float angular_radius);

/// Radiance of a sun drawn with another radius, as Mitsuba's sunRadiusScale and sun_aperture do it: what falls on
/// the ground stays the same, so a larger disk is dimmer. For a radius of 0, use sun_irradiance() with a
/// directional light.
Rgb resized_sun_radiance(Rgb radiance, float angular_radius);

/// What falls on a surface facing the sun, of any radius.
inline Rgb sun_irradiance(Rgb radiance) {
    return radiance * disk_solid_angle(sun_angular_radius);
}

/// When and where; the values are the defaults of both Mitsubas: Tokyo, 10 July 2010, 3 pm.
struct PlaceAndTime {
    double latitude = 35.6894;   ///< degrees, north positive
    double longitude = 139.6917; ///< degrees, east positive
    double timezone = 9;         ///< hours that local time is ahead of UT
    int year = 2010, month = 7, day = 10;
    double hour = 15, minute = 0, second = 0;
};

/// Where the sun stands, to half an arc minute for the years 1999 to 2015 [Blanco-Muriel 2001]: a unit vector with
/// +y up, +x east and -z north. Below the horizon its y is negative.
glm::vec3 sun_direction(const PlaceAndTime& when);

} // namespace tessera
