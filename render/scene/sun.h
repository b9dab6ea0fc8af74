#pragma once

#include "recon/image.h"

#include <glm/vec3.hpp>

namespace tessera {

/// Half the angle under which the sun's disk is seen, in radians: 0.5358 / 2 degrees, as in Mitsuba.
inline constexpr float sun_angular_radius = 0.2679f * 3.14159265f / 180;

/// Mean radiance of the sun's disk, in the unit of sky.h, after the air has taken its part [Preetham 1999, A.1];
/// Mitsuba 0.6 uses the same formulas. `elevation` above the horizon in radians, in [0, pi/2]; turbidity in
/// [1, 10]. Never negative: what lies outside sRGB is clamped.
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
