#pragma once

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

inline constexpr float pi = 3.14159265358979323846f;
inline constexpr float inv_pi = 1 / pi;

/// An orthonormal frame; `normal` is its z axis.
struct Frame {
    glm::vec3 tangent;
    glm::vec3 bitangent;
    glm::vec3 normal;

    Frame() = default;

    /// A frame around a unit normal [Duff 2017].
    explicit Frame(glm::vec3 n) : normal(n) {
        const float sign = std::copysign(1.0f, n.z);
        const float a = -1.0f / (sign + n.z);
        const float b = n.x * n.y * a;
        tangent = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
        bitangent = {b, sign + n.y * n.y * a, -n.y};
    }

    glm::vec3 to_local(glm::vec3 world) const {
        return {glm::dot(world, tangent), glm::dot(world, bitangent), glm::dot(world, normal)};
    }
    glm::vec3 to_world(glm::vec3 local) const {
        return local.x * tangent + local.y * bitangent + local.z * normal;
    }
};

/// Sine and cosine of an angle in [-pi/4, pi/4], by their series; to the last bit but one.
inline glm::vec2 sin_cos_quarter(float angle) {
    const float a2 = angle * angle;
    const float sine =
        angle * (1 + a2 * (-1.0f / 6 + a2 * (1.0f / 120 + a2 * (-1.0f / 5040 + a2 * (1.0f / 362880)))));
    const float cosine = 1 + a2 * (-0.5f + a2 * (1.0f / 24 + a2 * (-1.0f / 720 + a2 * (1.0f / 40320))));
    return {sine, cosine};
}

/// Uniform on the unit disk, by concentric rings [Shirley and Chiu 1997].
inline glm::vec2 sample_disk(glm::vec2 u) {
    const float x = 2 * u.x - 1;
    const float y = 2 * u.y - 1;
    const bool wide = std::abs(x) > std::abs(y);
    const float radius = wide ? x : y;
    if (radius == 0)
        return {0, 0};
    const glm::vec2 sc = radius * sin_cos_quarter(pi / 4 * ((wide ? y : x) / radius));
    return wide ? glm::vec2(sc.y, sc.x) : sc;
}

/// A direction about +z with pdf_w = cos / pi.
inline glm::vec3 sample_cosine_hemisphere(glm::vec2 u) {
    const glm::vec2 d = sample_disk(u);
    return {d.x, d.y, std::sqrt(std::max(1 - d.x * d.x - d.y * d.y, 0.0f))};
}

/// Barycentric coordinates (of the second and third corner), uniform on a triangle.
inline glm::vec2 sample_triangle(glm::vec2 u) {
    const float root = std::sqrt(1 - u.x);
    return {1 - root, u.y * root};
}

} // namespace tessera
