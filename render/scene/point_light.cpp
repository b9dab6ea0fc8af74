#include "render/scene/point_light.h"

#include "render/sampling/sampling.h"

#include <cmath>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace tessera {

glm::ivec2 Slide::size() const {
    const auto* texture = std::get_if<BitmapTexture>(&picture.kind);
    if (kind == Kind::share || !texture)
        return glm::ivec2(1);
    return {texture->bitmap->width, texture->bitmap->height};
}

Rgb Slide::toward(glm::vec3 direction) const {
    const glm::ivec2 pixels = size();
    const glm::vec4 seen = Projection(camera, pixels).project(direction);
    const float cos = seen.w;
    if (!(cos > 0))
        return Rgb(0);
    const glm::vec2 uv = glm::vec2(seen) / cos / glm::vec2(pixels);
    if (uv != glm::clamp(uv, 0.0f, 1.0f))
        return Rgb(0);
    const Rgb color = picture.evaluate({uv});
    // A plane at distance 1 receives cos^3 times the intensity: it is 1 / cos away and tilted.
    return kind == Kind::share ? color : color * (pi / (cos * cos * cos));
}

Rgb Slide::flux() const {
    const glm::vec2 pixels(size());
    const float width = Projection(camera, size()).pixel_width().at(1) * pixels.x;
    return pi * picture.mean() * (width * width * pixels.y / pixels.x);
}

Rgb PointLight::toward(glm::vec3 direction) const {
    const Rgb full = slide ? intensity * slide->toward(direction) : intensity;
    if (cutoff >= 180)
        return full;
    // atan2 is accurate for narrow cones, where acos is not.
    const float angle =
        glm::degrees(std::atan2(glm::length(glm::cross(direction, axis)), glm::dot(direction, axis)));
    if (angle <= beam_width)
        return full;
    return angle >= cutoff ? Rgb(0) : full * ((cutoff - angle) / (cutoff - beam_width));
}

double PointLight::power() const {
    if (slide && slide->kind == Slide::Kind::irradiance)
        return luminance(intensity * slide->flux());
    const double half_way = 0.5 * glm::radians(double(cutoff) + double(beam_width));
    const double solid_angle = 2 * double(pi) * (1 - std::cos(half_way));
    return solid_angle * luminance(slide ? intensity * slide->picture.mean() : intensity);
}

} // namespace tessera
