#include "render/scene/sky.h"

#include "recon/image.h"
#include "render/sampling/sampling.h"
#include "render/scene/environment.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <span>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// Returns the Perez coefficients of Y, x and y [Preetham 1999, A.2].
Sky::Perez perez_coefficients(float turbidity) {
    const glm::vec3 t(turbidity);
    return {glm::vec3(0.1787f, -0.0193f, -0.0167f) * t + glm::vec3(-1.4630f, -0.2592f, -0.2608f),
            glm::vec3(-0.3554f, -0.0665f, -0.0950f) * t + glm::vec3(0.4275f, 0.0008f, 0.0092f),
            glm::vec3(-0.0227f, -0.0004f, -0.0079f) * t + glm::vec3(5.3251f, 0.2125f, 0.2102f),
            glm::vec3(0.1206f, -0.0641f, -0.0441f) * t + glm::vec3(-2.5771f, -0.8989f, -1.6537f),
            glm::vec3(-0.0670f, -0.0033f, -0.0109f) * t + glm::vec3(0.3703f, 0.0452f, 0.0529f)};
}

/// Evaluates [Preetham 1999, eq. 3] for Y, x and y; `gamma` is the angle to the sun.
glm::vec3 distribution(const Sky::Perez& p, float cos_zenith_angle, float gamma) {
    const float cos_gamma = std::cos(gamma);
    const glm::vec3 by_height = 1.0f + p.a * glm::exp(p.b / std::max(cos_zenith_angle, 1e-3f));
    const glm::vec3 by_sun = 1.0f + p.c * glm::exp(p.d * gamma) + p.e * (cos_gamma * cos_gamma);
    return by_height * by_sun;
}

/// Returns Y (kcd/m^2), x and y at the zenith [Preetham 1999, A.2].
glm::vec3 zenith_color(float turbidity, float sun_zenith_angle) {
    const float t = turbidity, s = sun_zenith_angle;
    const float chi = (4.0f / 9 - t / 120) * (pi - 2 * s);
    const float luminance = (4.0453f * t - 4.9710f) * std::tan(chi) - 0.2155f * t + 2.4192f;
    const auto cubic = [s](float c3, float c2, float c1, float c0) { return ((c3 * s + c2) * s + c1) * s + c0; };
    const float x = cubic(0.00166f, -0.00375f, 0.00209f, 0) * t * t +
                    cubic(-0.02903f, 0.06377f, -0.03202f, 0.00394f) * t +
                    cubic(0.11693f, -0.21196f, 0.06052f, 0.25886f);
    const float y = cubic(0.00275f, -0.00610f, 0.00317f, 0) * t * t +
                    cubic(-0.04214f, 0.08970f, -0.04153f, 0.00516f) * t +
                    cubic(0.15346f, -0.26756f, 0.06670f, 0.26688f);
    return {luminance, x, y};
}

/// Converts luminance and chromaticity to linear sRGB.
Rgb rgb_of_Yxy(glm::vec3 Yxy) {
    const glm::vec3 xyz = Yxy.x / Yxy.z * glm::vec3(Yxy.y, Yxy.z, 1 - Yxy.y - Yxy.z);
    return rgb_of_xyz(xyz);
}

/// Returns the angle between two unit vectors; accurate for small angles, where the sky changes most.
float angle_between(glm::vec3 a, glm::vec3 b) {
    return 2 * std::atan2(glm::length(a - b), glm::length(a + b));
}

/// Returns the direction with the same azimuth and another zenith angle.
glm::vec3 at_zenith_angle(glm::vec3 direction, float zenith_angle) {
    const float across = std::hypot(direction.x, direction.z);
    const float sine = std::sin(zenith_angle);
    if (across == 0)
        return {sine, std::cos(zenith_angle), 0};
    return {direction.x / across * sine, std::cos(zenith_angle), direction.z / across * sine};
}

} // namespace

Sky make_sky(const SkySettings& settings) {
    Sky sky;
    sky.settings = settings;
    if (settings.sun_direction.y < 0)
        sky.settings.sun_direction = at_zenith_angle(settings.sun_direction, pi / 2);
    const float turbidity = std::clamp(settings.turbidity, 2.0f, 10.0f);
    const float sun_zenith_angle = angle_between(sky.settings.sun_direction, {0, 1, 0});
    sky.perez = perez_coefficients(turbidity);
    sky.zenith = zenith_color(turbidity, sun_zenith_angle) / distribution(sky.perez, 1, sun_zenith_angle);
    return sky;
}

Rgb sky_radiance(const Sky& sky, glm::vec3 direction) {
    const float zenith_angle = angle_between(direction, {0, 1, 0});
    float stretched = zenith_angle / sky.settings.stretch;
    float fade = 1;
    if (stretched >= pi / 2) {
        if (!sky.settings.extend)
            return Rgb(0);
        stretched = pi / 2; // the colour of the horizon
    }
    if (sky.settings.extend) // smoothstep from the nadir to the horizon, as in Mitsuba 0.6
        fade = glm::smoothstep(0.0f, 1.0f, 2 - 2 * zenith_angle * inv_pi);
    if (stretched != zenith_angle)
        direction = at_zenith_angle(direction, stretched);
    const float gamma = angle_between(direction, sky.settings.sun_direction);
    const glm::vec3 Yxy = sky.zenith * distribution(sky.perez, std::cos(stretched), gamma);
    const Rgb rgb = glm::max(rgb_of_Yxy(Yxy), 0.0f) * (1000 / candela_per_radiance);
    return fade * sky.settings.scale * rgb;
}

Bitmap sky_bitmap(const Sky& sky, int width) {
    Bitmap bitmap;
    bitmap.width = width;
    bitmap.height = width / 2;
    bitmap.floats.reserve(static_cast<std::size_t>(bitmap.width) * static_cast<std::size_t>(bitmap.height));
    for (int y = 0; y < bitmap.height; ++y)
        for (int x = 0; x < bitmap.width; ++x) {
            const glm::vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(bitmap.width),
                               static_cast<float>(y) / static_cast<float>(bitmap.height - 1));
            bitmap.floats.push_back(sky_radiance(sky, direction_of_map(uv)));
        }
    return bitmap;
}

namespace {

/// An entry of a table: a value at a wavelength in nm.
struct Sample {
    float wavelength, value;
};

/// Interpolates a table linearly; 0 outside its range.
float look_up(std::span<const Sample> table, float wavelength) {
    const auto above = std::upper_bound(table.begin(), table.end(), wavelength,
                                        [](float w, const Sample& s) { return w < s.wavelength; });
    if (above == table.begin() || above == table.end())
        return 0;
    const Sample& a = *(above - 1);
    const float t = (wavelength - a.wavelength) / (above->wavelength - a.wavelength);
    return a.value + t * (above->value - a.value);
}

// Tables of [Preetham 1999, A.1]; absorption after [Iqbal 1983].

/// Radiance of the sun outside the atmosphere, W / (m^2 sr nm), from 380 nm in steps of 10 nm.
constexpr std::array<float, 38> solar{
    16559.0f, 16233.7f, 21127.5f, 25888.2f, 25829.1f, 24232.3f, 26760.5f, 29658.3f, 30545.4f, 30057.5f,
    30663.7f, 28830.4f, 28712.1f, 27825.0f, 27100.6f, 27233.6f, 26361.3f, 25503.8f, 25060.2f, 25311.6f,
    25355.9f, 25134.2f, 24631.5f, 24173.2f, 23685.3f, 23212.1f, 22827.7f, 22339.8f, 21970.2f, 21526.7f,
    21097.9f, 20728.3f, 20240.4f, 19870.8f, 19427.2f, 19072.4f, 18628.9f, 18259.2f};

/// Absorption coefficient of ozone, 1/cm.
constexpr std::array<Sample, 53> ozone{
    {{355, 0},      {445, 0.003f}, {450, 0.003f}, {455, 0.004f}, {460, 0.006f}, {465, 0.008f}, {470, 0.009f},
     {475, 0.012f}, {480, 0.014f}, {485, 0.017f}, {490, 0.021f}, {495, 0.025f}, {500, 0.03f},  {505, 0.035f},
     {510, 0.04f},  {515, 0.045f}, {520, 0.048f}, {525, 0.057f}, {530, 0.063f}, {535, 0.07f},  {540, 0.075f},
     {545, 0.08f},  {550, 0.085f}, {555, 0.095f}, {560, 0.103f}, {565, 0.11f},  {570, 0.12f},  {575, 0.122f},
     {580, 0.12f},  {585, 0.118f}, {590, 0.115f}, {595, 0.12f},  {600, 0.125f}, {605, 0.13f},  {610, 0.12f},
     {620, 0.105f}, {630, 0.09f},  {640, 0.079f}, {650, 0.067f}, {660, 0.057f}, {670, 0.048f}, {680, 0.036f},
     {690, 0.028f}, {700, 0.023f}, {710, 0.018f}, {720, 0.014f}, {730, 0.011f}, {740, 0.01f},  {750, 0.009f},
     {760, 0.007f}, {770, 0.004f}, {780, 0},      {790, 0}}};

/// Absorption coefficient of water vapour, 1/cm. Mixed gases absorb beyond 759 nm, outside the table `solar`.
constexpr std::array<Sample, 8> water{{{689, 0},
                                       {690, 0.016f},
                                       {700, 0.024f},
                                       {710, 0.0125f},
                                       {720, 1},
                                       {730, 0.87f},
                                       {740, 0.061f},
                                       {750, 0.001f}}};

/// Returns the transmittance of the atmosphere for a relative air mass [Preetham 1999, A.1].
float transmittance(float wavelength, float air_mass, float turbidity) {
    const float micrometre = wavelength / 1000;
    const float rayleigh = 0.008735f * std::pow(micrometre, -4.08f);
    const float beta = 0.04608365822050f * turbidity - 0.04586025928522f; // amount of aerosols
    const float aerosol = beta * std::pow(micrometre, -1.3f);
    const float ozone_layer = 0.35f * look_up(ozone, wavelength);
    const float vapour = 2 * air_mass * look_up(water, wavelength); // 2 cm of water
    return std::exp(-air_mass * (rayleigh + aerosol + ozone_layer) -
                    0.2385f * vapour / std::pow(1 + 20.07f * vapour, 0.45f));
}

} // namespace

Rgb sun_radiance(float turbidity, float elevation) {
    const float zenith_degrees = 90 - std::clamp(elevation, 0.0f, pi / 2) * 180 / pi;
    const float air_mass = 1 / (std::sin(std::clamp(elevation, 0.0f, pi / 2)) +
                                0.15f * std::pow(93.885f - zenith_degrees, -1.253f)); // [Preetham 1999, eq. 14]
    glm::vec3 xyz(0);
    for (std::size_t i = 0; i < solar.size(); ++i) {
        const float wavelength = 380 + 10 * static_cast<float>(i);
        xyz += solar[i] * transmittance(wavelength, air_mass, turbidity) * color_matching(wavelength);
    }
    xyz *= 10 / 106.856980f; // step in nm over the integral of y
    return glm::max(rgb_of_xyz(xyz), 0.0f);
}

float disk_solid_angle(float angular_radius) {
    const float s = std::sin(0.5f * angular_radius);
    return 4 * pi * s * s; // equals 2 pi (1 - cos) without cancellation
}

Rgb resized_sun_radiance(Rgb radiance, float angular_radius) {
    return radiance * (disk_solid_angle(sun_angular_radius) / disk_solid_angle(angular_radius));
}

glm::vec3 sun_direction(const PlaceAndTime& when) {
    using namespace std::chrono;
    constexpr double degree = 3.14159265358979323846 / 180;
    // Days since noon of 1 January 2000, UT.
    const sys_days day = std::chrono::year(when.year) / when.month / when.day;
    const sys_days start = std::chrono::year(2000) / 1 / 1;
    const double hours = when.hour - when.timezone + (when.minute + when.second / 60) / 60;
    const double n = static_cast<double>((day - start).count()) - 0.5 + hours / 24;

    // Ecliptic coordinates of the sun [Blanco-Muriel 2001, eqs. 3 to 7].
    const double omega = 2.1429 - 0.0010394594 * n;
    const double mean_longitude = 4.8950630 + 0.017202791698 * n;
    const double anomaly = 6.2400600 + 0.0172019699 * n;
    const double longitude = mean_longitude + 0.03341607 * std::sin(anomaly) + 0.00034894 * std::sin(2 * anomaly) -
                             0.0001134 - 0.0000203 * std::sin(omega);
    const double obliquity = 0.4090928 - 6.2140e-9 * n + 0.0000396 * std::cos(omega);

    // Equatorial coordinates, then by sidereal time to the local horizon [eqs. 8 to 12].
    const double right_ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
    const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));
    const double sidereal_hours = 6.6974243242 + 0.0657098283 * n + hours;
    const double hour_angle = (15 * sidereal_hours + when.longitude) * degree - right_ascension;
    const double latitude = when.latitude * degree;

    const double up = std::cos(latitude) * std::cos(hour_angle) * std::cos(declination) +
                      std::sin(latitude) * std::sin(declination);
    const double east = -std::sin(hour_angle) * std::cos(declination);
    const double north = std::cos(latitude) * std::sin(declination) -
                         std::sin(latitude) * std::cos(hour_angle) * std::cos(declination);
    // Parallax: the observer is on the earth's surface, not at its centre [eq. 15].
    constexpr double parallax = 6371.01 / 149597890;
    const double zenith_angle = std::atan2(std::hypot(east, north), up);
    const double apparent_angle = zenith_angle + parallax * std::sin(zenith_angle);
    const double azimuth = std::atan2(east, north);
    return {static_cast<float>(std::sin(azimuth) * std::sin(apparent_angle)),
            static_cast<float>(std::cos(apparent_angle)),
            static_cast<float>(-std::cos(azimuth) * std::sin(apparent_angle))};
}

} // namespace tessera
