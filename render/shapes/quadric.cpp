#include "render/shapes/quadric.h"

#include <stdexcept>
#include <utility>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace tessera {

namespace {

bool is_finite(const glm::dmat4& m) {
    constexpr double largest = 1e30; // not tuned
    for (int i = 0; i < 16; ++i)
        if (!(std::abs(m[i / 4][i % 4]) < largest))
            return false;
    return true;
}

double squared(double x) {
    return x * x;
}

/// Returns the radius if the map of a sphere is a similarity up to rounding, else 0.
double radius_of(const glm::dmat3& m) {
    constexpr double tolerance = 1e-5;
    const double radius = std::cbrt(std::abs(glm::determinant(m)));
    const glm::dmat3 squares = glm::transpose(m) * m / (radius * radius);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(squares[i][j] - (i == j ? 1 : 0)) < tolerance))
                return 0;
    return radius;
}

/// Returns the similarity of this radius that is nearest to m, by one step of Newton's iteration.
glm::dmat3 similarity(const glm::dmat3& m, double radius) {
    return 0.5 * (m + radius * radius * glm::transpose(glm::inverse(m)));
}

/// Solves |o + t d|^2 = 1 for t. Returns whether there are solutions, in ascending order.
template <class Vector>
bool intersect_unit(Vector o, Vector d, double& t0, double& t1) {
    const double a = glm::dot(d, d), b = glm::dot(o, d);
    if (!(a > 0))
        return false;
    const Vector nearest = o - b / a * d; // its square is exact even for distant origins
    const double rest = 1 - glm::dot(nearest, nearest);
    if (!(rest >= 0))
        return false;
    const double q = -(b + std::copysign(std::sqrt(a * rest), b));
    t0 = q / a;
    t1 = q != 0 ? (glm::dot(o, o) - 1) / q : t0;
    if (t0 > t1)
        std::swap(t0, t1);
    return true;
}

} // namespace

Quadric::Quadric(Kind kind, const glm::mat4& to_world, bool flip_normals) : kind_(kind) {
    glm::dmat4 m(to_world);
    if (kind == Kind::disk) {
        // The axis is only a side: it may be singular.
        const glm::dvec3 across = glm::cross(glm::dvec3(m[0]), glm::dvec3(m[1]));
        const double length = glm::length(across), size = std::sqrt(length);
        const double sign = glm::dot(across, glm::dvec3(m[2])) < 0 ? -1 : 1;
        m[2] = glm::dvec4(sign * size / length * across, 0);
    }
    if (const double radius = kind == Kind::sphere ? radius_of(glm::dmat3(m)) : 0; radius > 0) {
        radius_ = static_cast<float>(radius);
        const glm::dmat3 exact = similarity(glm::dmat3(m), radius);
        for (int i = 0; i < 3; ++i)
            m[i] = glm::dvec4(exact[i], 0);
    }
    const double determinant = glm::determinant(glm::dmat3(m));
    to_local_ = glm::inverse(m);
    if (!is_finite(m) || !is_finite(to_local_))
        throw std::runtime_error("the transform of the shape must be finite and have an inverse");
    to_world_ = glm::mat4(m);
    side_ = flip_normals != (kind == Kind::sphere && determinant < 0) ? -1.0f : 1.0f;

    glm::dmat3 cofactors = determinant * glm::transpose(glm::dmat3(to_local_));
    if (determinant < 0)
        cofactors *= -1;
    double largest = 0;
    for (int i = 0; i < 9; ++i)
        largest = std::max(largest, std::abs(cofactors[i / 3][i % 3]));
    to_normals_ = glm::mat3(cofactors / largest);
    area_scale_ = static_cast<float>(largest);
    area_ = measured_area();
}

/// Integrates the change of area over the shape in its own space.
double Quadric::measured_area() const {
    const auto scale = [&](glm::vec3 local) {
        return static_cast<double>(area_scale_) * static_cast<double>(glm::length(to_normals_ * gradient(local)));
    };
    if (kind_ == Kind::disk || radius_ > 0)
        return scale({0, 0, 1}) * static_cast<double>(local_area());
    constexpr int rows = 64, columns = 128;
    double sum = 0;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const float z = kind_ == Kind::sphere ? 2 * (static_cast<float>(i) + 0.5f) / rows - 1 : 0;
            const float phi = 2 * pi * (static_cast<float>(j) + 0.5f) / columns, sine = std::sqrt(1 - z * z);
            sum += scale({sine * std::cos(phi), sine * std::sin(phi), z});
        }
    return sum / (rows * columns) * static_cast<double>(local_area());
}

int Quadric::intersect(glm::vec3 origin, glm::vec3 direction, std::array<Hit, 2>& hits) const {
    // In double, as a small shape far from the origin needs it.
    const glm::dvec3 o(to_local_ * glm::dvec4(origin, 1)), d = glm::dmat3(to_local_) * glm::dvec3(direction);
    if (kind_ == Kind::disk) {
        const double t = -o.z / d.z;
        const glm::dvec2 p = glm::dvec2(o) + t * glm::dvec2(d);
        if (!(glm::dot(p, p) <= 1))
            return 0;
        hits[0] = {t, glm::vec3(p, 0)};
        return 1;
    }
    double t[2];
    const bool meets = kind_ == Kind::sphere ? intersect_unit(o, d, t[0], t[1])
                                             : intersect_unit(glm::dvec2(o), glm::dvec2(d), t[0], t[1]);
    int count = 0;
    for (int i = 0; meets && i < 2; ++i) {
        const glm::dvec3 p = o + t[i] * d;
        if (kind_ == Kind::sphere || (p.z >= 0 && p.z <= 1))
            hits[count++] = {t[i], onto_surface(glm::vec3(p))};
    }
    return count;
}

Quadric::Bounds Quadric::bounds() const {
    const glm::dmat4 m(to_world_);
    glm::dvec3 center(m[3]), half;
    const bool is_cylinder = kind_ == Kind::cylinder;
    for (int i = 0; i < 3; ++i) {
        const double round = squared(m[0][i]) + squared(m[1][i]);
        half[i] = std::sqrt(kind_ == Kind::sphere ? round + squared(m[2][i]) : round);
        if (is_cylinder) {
            half[i] += std::abs(m[2][i]) / 2;
            center[i] += m[2][i] / 2;
        }
    }
    half += 1e-6 * (glm::abs(center) + half); // for rounding to float
    return {glm::vec3(center - half), glm::vec3(center + half)};
}

glm::vec3 Quadric::onto_surface(glm::vec3 local) const {
    switch (kind_) {
    case Kind::sphere:
        return glm::normalize(local);
    case Kind::disk:
        return {local.x, local.y, 0};
    case Kind::cylinder:
        break;
    }
    return {glm::normalize(glm::vec2(local)), local.z};
}

glm::vec2 Quadric::uv(glm::vec3 local) const {
    const float angle = angle_of(local.y, local.x) / (2 * pi), turns = angle < 0 ? angle + 1 : angle;
    const float across = glm::length(glm::vec2(local));
    switch (kind_) {
    case Kind::sphere:
        return {turns, angle_of(across, local.z) / pi};
    case Kind::disk:
        return {across, turns};
    case Kind::cylinder:
        break;
    }
    return {turns, local.z};
}

std::array<glm::vec3, 2> Quadric::derivatives(glm::vec3 local) const {
    constexpr float least = 1e-6f; // of the distance from the axis
    const float across = glm::length(glm::vec2(local));
    const glm::vec2 out = across > least ? glm::vec2(local) / across : glm::vec2(1, 0);
    const float radius = kind_ == Kind::cylinder ? 1 : std::max(across, least);
    const glm::vec3 around = 2 * pi * radius * glm::vec3(-out.y, out.x, 0);
    switch (kind_) {
    case Kind::sphere:
        return {around, pi * glm::vec3(local.z * out, -radius)};
    case Kind::disk:
        return {glm::vec3(out, 0), around};
    case Kind::cylinder:
        break;
    }
    return {around, glm::vec3(0, 0, 1)};
}

} // namespace tessera
