#include "render/scene/sky.h"

#include "render/sampling.h"
#include "render/scene/color_space.h"
#include "render/scene/environment.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// [Preetham 1999, A.2]
Sky::Perez perez_coefficients(float turbidity) {
    const glm::vec3 t(turbidity);
    return {glm::vec3(0.1787f, -0.0193f, -0.0167f) * t + glm::vec3(-1.4630f, -0.2592f, -0.2608f),
            glm::vec3(-0.3554f, -0.0665f, -0.0950f) * t + glm::vec3(0.4275f, 0.0008f, 0.0092f),
            glm::vec3(-0.0227f, -0.0004f, -0.0079f) * t + glm::vec3(5.3251f, 0.2125f, 0.2102f),
            glm::vec3(0.1206f, -0.0641f, -0.0441f) * t + glm::vec3(-2.5771f, -0.8989f, -1.6537f),
            glm::vec3(-0.0670f, -0.0033f, -0.0109f) * t + glm::vec3(0.3703f, 0.0452f, 0.0529f)};
}

/// [Preetham 1999, eq. 3] for Y, x and y. `gamma` is the angle to the sun.
glm::vec3 distribution(const Sky::Perez& p, float cos_zenith_angle, float gamma) {
    const float cos_gamma = std::cos(gamma);
    const glm::vec3 by_height = 1.0f + p.a * glm::exp(p.b / std::max(cos_zenith_angle, 1e-3f));
    const glm::vec3 by_sun = 1.0f + p.c * glm::exp(p.d * gamma) + p.e * (cos_gamma * cos_gamma);
    return by_height * by_sun;
}

/// Y in kcd/m^2, x and y at the zenith [Preetham 1999, A.2].
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

/// From luminance and chromaticity to linear sRGB.
Rgb rgb_of_Yxy(glm::vec3 Yxy) {
    const glm::vec3 xyz = Yxy.x / Yxy.z * glm::vec3(Yxy.y, Yxy.z, 1 - Yxy.y - Yxy.z);
    return rgb_of_xyz(xyz);
}

/// The angle between two unit vectors; exact for small ones too, where the sky changes most.
float angle_between(glm::vec3 a, glm::vec3 b) {
    return 2 * std::atan2(glm::length(a - b), glm::length(a + b));
}

/// The same azimuth, with another zenith angle.
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
    if (sky.settings.extend) // as Mitsuba 0.6 does: smoothstep from the nadir up to the horizon
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

} // namespace tessera
