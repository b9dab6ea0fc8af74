// Emitter sampling of spheres, disks and cylinders.
#include "render/sampling/sampling.h"
#include "render/scene/light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

/// A direction at an angle from the axis of a cone, and the point in which it meets the ball in the cone.
struct ConeSample {
    Frame frame; // about the direction from the receiver to the ball's centre
    float sine, cosine;
    glm::vec2 around;
    float distance;   // from the receiver to the point
    glm::vec3 normal; // of the ball there

    glm::vec3 direction() const {
        return sine * (around.x * frame.tangent + around.y * frame.bitangent) + cosine * frame.normal;
    }
};

/// Samples the cone in which a receiver outside of a ball sees it, uniformly per solid angle.
ConeSample sample_cone(const Quadric& ball, glm::vec3 receiver, glm::vec2 u) {
    const glm::vec3 to_center = ball.center() - receiver;
    const float distance2 = glm::dot(to_center, to_center), distance = std::sqrt(distance2);
    const float largest = ball.sine2_from(distance2); // squared sine at the rim
    const float height = u.x * Quadric::cone_height(largest), sine2 = height * (2 - height);
    ConeSample s{Frame(to_center / distance), std::sqrt(sine2), 1 - height, {}, 0, {}};
    const glm::vec2 sc = sin_cos_of_turns(u.y);
    s.around = {sc.y, sc.x};
    // The angle at the centre between receiver and point, by the laws of cosines and sines.
    const float inner = std::sqrt(std::max(1 - sine2 / largest, 0.0f));
    s.distance = distance * s.cosine - ball.radius() * inner;
    const float sine = s.sine * s.distance / ball.radius(), cosine = sine2 / std::sqrt(largest) + s.cosine * inner;
    s.normal = glm::normalize(sine * (s.around.x * s.frame.tangent + s.around.y * s.frame.bitangent) -
                              cosine * s.frame.normal);
    return s;
}

/// Returns a local point of a quadric, uniform in its own space.
glm::vec3 sample_local(Quadric::Kind kind, glm::vec2 u) {
    if (kind == Quadric::Kind::cylinder) {
        const glm::vec2 sc = sin_cos_of_turns(u.x);
        return {sc.y, sc.x, u.y};
    }
    const glm::vec2 sc = sin_cos_of_turns(u.y);
    const float z = kind == Quadric::Kind::sphere ? 1 - 2 * u.x : 0;
    const float radius = kind == Quadric::Kind::sphere ? 2 * std::sqrt(u.x * (1 - u.x)) : std::sqrt(u.x);
    return {radius * sc.y, radius * sc.x, z};
}

/// Returns the derivatives of sample_local().
std::array<glm::vec3, 2> differentiate_local(Quadric::Kind kind, glm::vec2 u) {
    const glm::vec3 p = sample_local(kind, u);
    const glm::vec3 around = 2 * pi * glm::vec3(-p.y, p.x, 0);
    if (kind == Quadric::Kind::cylinder)
        return {around, glm::vec3(0, 0, 1)};
    const float radius2 = std::max(p.x * p.x + p.y * p.y, 1e-12f);
    if (kind == Quadric::Kind::disk)
        return {glm::vec3(p.x, p.y, 0) / (2 * radius2), around};
    return {glm::vec3(2 * p.z * p.x / radius2, 2 * p.z * p.y / radius2, -2), around};
}

} // namespace

bool LightQuadric::sample(glm::vec3 receiver, glm::vec2 u, LightPoint& point) const {
    glm::vec3 local;
    if (quadric->is_ball()) {
        const glm::vec3 d = receiver - quadric->center();
        if (!(glm::dot(d, d) > quadric->radius() * quadric->radius()))
            return false;
        point.kind = LightPoint::Kind::ball;
        point.normal = sample_cone(*quadric, receiver, u).normal;
        point.position = quadric->center() + quadric->radius() * point.normal;
        point.pdf = probability;
        point.ball = quadric;
        if (radiance_map)
            local = glm::transpose(glm::mat3(quadric->to_world())) * point.normal; // a similarity
    } else {
        local = sample_local(quadric->kind(), u);
        point.kind = LightPoint::Kind::surface;
        point.normal = quadric->normal(local);
        point.position = quadric->position(local);
        point.pdf = probability * quadric->pdf_a(local);
        if (!(glm::dot(receiver - point.position, point.normal) > 0))
            return false;
    }
    point.radiance = radiance_map ? radiance_map->evaluate(quadric->uv(local)) : radiance;
    return true;
}

std::array<glm::vec3, 2> LightQuadric::differentiate(glm::vec3 receiver, glm::vec2 u) const {
    if (!quadric->is_ball()) {
        const auto [a, b] = differentiate_local(quadric->kind(), u);
        return {quadric->vector(a), quadric->vector(b)};
    }
    const ConeSample s = sample_cone(*quadric, receiver, u);
    const glm::vec3 to_center = quadric->center() - receiver, direction = s.direction();
    const float height = Quadric::cone_height(quadric->sine2_from(glm::dot(to_center, to_center)));
    const glm::vec3 outward = s.around.x * s.frame.tangent + s.around.y * s.frame.bitangent;
    const glm::vec3 turns[2] = {height / std::max(s.sine, 1e-6f) * (s.cosine * outward - s.sine * s.frame.normal),
                                2 * pi * s.sine * (s.around.x * s.frame.bitangent - s.around.y * s.frame.tangent)};
    std::array<glm::vec3, 2> derivatives;
    for (int i = 0; i < 2; ++i) // the point stays in the tangent plane
        derivatives[i] =
            s.distance * (turns[i] - direction * (glm::dot(s.normal, turns[i]) / glm::dot(s.normal, direction)));
    return derivatives;
}

} // namespace tessera
