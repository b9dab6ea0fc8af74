#include "render/inspect/differentiation.h"

#include "render/sampling/sampling.h"
#include "render/surface/material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// Two tangents of the surface at a hit, in world space: sides of the triangle, or unit vectors of a quadric's own
/// space.
class TangentPlane {
public:
    TangentPlane(const ShapeRecord& shape, const Hit& hit) : quadric_(shape.quadric) {
        if (quadric_) {
            local_ = quadric_->derivatives(hit.local);
            for (glm::vec3& tangent : local_)
                tangent = glm::normalize(tangent);
            a_ = quadric_->vector(local_[0]);
            b_ = quadric_->vector(local_[1]);
        } else {
            const glm::uvec3 t = shape.triangles[hit.triangle];
            a_ = shape.positions[t.y] - shape.positions[t.x];
            b_ = shape.positions[t.z] - shape.positions[t.x];
        }
        if (hit.placement) {
            a_ = hit.placement->vector(a_);
            b_ = hit.placement->vector(b_);
        }
    }

    /// Returns the coordinates of a vector in the plane, in units of the tangents.
    glm::vec2 coordinates(glm::vec3 along) const { return coordinates_along(along, a_, b_); }
    float shortest_side() const { return std::min(glm::length(a_), glm::length(b_ - a_)); }

    /// Moves a hit on the surface by a vector in the plane.
    void move(Hit& hit, glm::vec3 along) const {
        const glm::vec2 by = coordinates(along);
        if (!quadric_) {
            hit.barycentric += by;
            return;
        }
        hit.local = quadric_->onto_surface(hit.local + by.x * local_[0] + by.y * local_[1]);
        hit.geometric_normal = quadric_->normal(hit.local);
        if (hit.placement)
            hit.geometric_normal = glm::normalize(hit.placement->of_normals * hit.geometric_normal);
    }

    /// Returns the derivatives of a normal by the coordinates, and sets `normal` to it. Its length is arbitrary.
    std::array<glm::vec3, 2> normal_derivatives(const ShapeRecord& shape, const Hit& hit,
                                                glm::vec3& normal) const {
        std::array<glm::vec3, 2> by;
        if (quadric_) {
            normal = quadric_->scaled_normal(hit.local);
            by = {quadric_->scaled_normal(local_[0]), quadric_->scaled_normal(local_[1])};
        } else {
            const glm::uvec3 t = shape.triangles[hit.triangle];
            const glm::vec3 n0 = shape.normals[t.x];
            by = {shape.normals[t.y] - n0, shape.normals[t.z] - n0};
            normal = n0 + hit.barycentric.x * by[0] + hit.barycentric.y * by[1];
        }
        if (hit.placement)
            for (glm::vec3* n : {&by[0], &by[1], &normal})
                *n = hit.placement->of_normals * *n;
        return by;
    }

private:
    const Quadric* quadric_;           // null: a triangle
    std::array<glm::vec3, 2> local_{}; // tangents of a quadric in its own space
    glm::vec3 a_, b_;
};

/// Returns whether shading normals vary over the hit surface.
bool is_curved(const ShapeRecord& shape, const Hit& hit) {
    if (shape.quadric)
        return shape.quadric->is_curved();
    if (!shape.normals)
        return false;
    const glm::uvec3 t = shape.triangles[hit.triangle];
    return shape.normals[t.x] != shape.normals[t.y] || shape.normals[t.x] != shape.normals[t.z];
}

/// Rotation of the shading frame when a hit moves in its plane.
class FrameTurns {
public:
    FrameTurns(const ShapeRecord& shape, const Hit& hit, const Frame& frame) : plane_(shape, hit), frame_(frame) {
        glm::vec3 sum;
        by_coordinate_ = plane_.normal_derivatives(shape, hit, sum);
        // The frame's normal may be flipped, by a two-sided material.
        const float length = glm::length(sum), scale = std::copysign(1 / length, glm::dot(sum, frame.normal));
        for (glm::vec3& n : by_coordinate_)
            n = scale * n - glm::dot(scale * n, frame.normal) * frame.normal;
    }

    /// Returns the rotation vector per unit of distance along a direction; its length is an angle in radians.
    glm::vec3 along(glm::vec3 direction) const {
        const glm::vec2 by = plane_.coordinates(direction);
        const glm::vec3 change = by.x * by_coordinate_[0] + by.y * by_coordinate_[1];
        const float size = glm::length(change);
        if (!(size > 0))
            return glm::vec3(0);
        // Differences of Frame include the turn of its tangent around the normal.
        const float step = 1e-3f / size;
        const Frame here(frame_.normal);
        Frame more(glm::normalize(frame_.normal + step * change)),
            less(glm::normalize(frame_.normal - step * change));
        float apart = 2 * step;
        // Where the normal's z changes its sign, the tangent jumps. The difference is then taken on one side.
        const auto jumps = [](const Frame& a, const Frame& b) { return glm::dot(a.tangent, b.tangent) < 0.99f; };
        if (jumps(less, more)) {
            (jumps(here, more) ? more : less) = here;
            apart = step;
        }
        return (glm::cross(less.tangent, more.tangent) + glm::cross(less.bitangent, more.bitangent) +
                glm::cross(less.normal, more.normal)) /
               (2 * apart);
    }

private:
    TangentPlane plane_;
    const Frame& frame_;
    std::array<glm::vec3, 2> by_coordinate_;
};

bool is_plain_diffuse(const Vertex& x) {
    return std::holds_alternative<Diffuse>(x.bsdf.kind) && !x.bsdf.has_relief() && !x.guide;
}

bool is_constant(const Texture& texture) {
    return texture.is_constant();
}
bool is_constant(const std::optional<Texture>& texture) {
    return !texture || texture->is_constant();
}

/// Returns whether textures change the directions of a scatter, and not only its reflectance. Returns true for
/// materials with many textures without looking at them.
bool scatters_by_texture(const ShapeRecord& shape) {
    if (!shape.has_uv() && !shape.attributed)
        return false;
    if (shape.has_frame_along_u && (shape.normals || shape.quadric))
        return true; // the frame follows the texture's u
    if (shape.material->relief || shape.material->back)
        return true;
    const auto& kind = shape.material->kind;
    if (const auto* m = std::get_if<DiffuseMaterial>(&kind))
        return !is_constant(m->alpha);
    if (const auto* m = std::get_if<ConductorMaterial>(&kind))
        return !is_constant(m->alpha) || !is_constant(m->alpha_v);
    if (const auto* m = std::get_if<DielectricMaterial>(&kind))
        return !is_constant(m->alpha) || !is_constant(m->alpha_v);
    if (const auto* m = std::get_if<PhongMaterial>(&kind))
        return !is_constant(m->exponent);
    return !std::holds_alternative<PlasticMaterial>(kind);
}

/// Differentiates the sampling routine of a scatter by finite differences.
class MovedScatter {
public:
    MovedScatter(const Scene& scene, const Ray& ray, const Hit& hit, const Vertex& x, const Scattering& s,
                 bool has_textures)
        : scene_(scene), ray_(ray), hit_(hit), x_(x), s_(s),
          base_{x.to_world(s.to_next), std::log(luminance(s.f_cos))},
          // Narrow lobes need smaller steps.
          angle_(2e-3f * (s.is_delta ? 1 : std::clamp(10 * x.bsdf.roughness(), 0.1f, 1.0f))) {
        if (has_textures)
            moved_vertex_ = x;
    }

    /// Returns the derivative by the scatter's random numbers along an axis.
    Turn by_number(glm::vec2 axis) const {
        constexpr float step = 2e-3f;
        const glm::vec2 more = glm::min(s_.u + step * axis, 0x1.fffffep-1f),
                        less = glm::max(s_.u - step * axis, 0.0f);
        return differ(scattered(x_, x_.to_previous, more), glm::dot(more - s_.u, axis),
                      scattered(x_, x_.to_previous, less), glm::dot(s_.u - less, axis));
    }
    /// Returns the derivative by the incident direction, per radian toward a perpendicular direction.
    Turn by_direction(glm::vec3 across) const {
        return differ(seen_from(angle_ * across), angle_, seen_from(-angle_ * across), angle_);
    }
    /// Returns the derivative by the position along a unit vector in the plane, including texture lookups.
    Turn by_position(glm::vec3 along) {
        const float step = std::min(angle_ * hit_.distance, 0.2f * TangentPlane(shape(), hit_).shortest_side());
        return differ(moved(step * along), step, moved(-step * along), step);
    }

private:
    const ShapeRecord& shape() const { return scene_.record(hit_.shape); }

    std::optional<Turn> scattered(const Vertex& x, glm::vec3 to_previous, glm::vec2 u) const {
        const auto s = x.sample_from(to_previous, s_.lobe, u);
        if (!s || s->is_delta != s_.is_delta || s->scatter != s_.scatter)
            return {};
        return Turn{x.to_world(s->to_next), std::log(luminance(s->f_cos))};
    }

    std::optional<Turn> seen_from(glm::vec3 turn) const { // incident direction plus `turn`
        return scattered(x_, x_.to_local(-glm::normalize(ray_.direction + turn)), s_.u);
    }

    std::optional<Turn> moved(glm::vec3 by) {
        Hit hit = hit_;
        TangentPlane(shape(), hit_).move(hit, by);
        make_vertex(scene_, hit, {ray_.origin + by, ray_.direction}, moved_vertex_);
        moved_vertex_.guide = x_.guide;
        return scattered(moved_vertex_, moved_vertex_.to_previous, s_.u);
    }

    /// Returns the central difference, or a one-sided one if the other side chooses another scatter.
    Turn differ(const std::optional<Turn>& more, float step_up, const std::optional<Turn>& less,
                float step_down) const {
        const Turn &high = more ? *more : base_, &low = less ? *less : base_;
        const float step = (more ? step_up : 0) + (less ? step_down : 0);
        if (!(step > 0))
            return {};
        return {(high.direction - low.direction) / step, (high.log_value - low.log_value) / step};
    }

    const Scene& scene_;
    const Ray& ray_;
    const Hit& hit_;
    const Vertex& x_;
    const Scattering& s_;
    Turn base_;
    float angle_; ///< step of directions, radians
    Vertex moved_vertex_;
};

/// Returns the derivatives of sample_cosine_hemisphere() by both numbers, in the local frame.
/// @param to_next  its result for u
std::array<Turn, 2> turns_of_cosine(glm::vec2 u, glm::vec3 to_next) {
    // Concentric map [Shirley and Chiu 1997]: the radius is one coordinate, and the angle is the quotient of both.
    const float x = 2 * u.x - 1, y = 2 * u.y - 1;
    const bool wide = std::abs(x) > std::abs(y);
    const float radius = wide ? x : y;
    if (radius == 0)
        return {};
    const float angle = pi / 4 * ((wide ? y : x) / radius);
    const float c = (wide ? to_next.x : to_next.y) / radius, s = (wide ? to_next.y : to_next.x) / radius;
    const glm::vec2 outward(c + angle * s, s - angle * c), around(pi / 4 * glm::vec2(-s, c));
    const auto turn = [&](glm::vec2 d) {
        const float down = -2 * (to_next.x * d.x + to_next.y * d.y) / to_next.z;
        return Turn{{2 * d.x, 2 * d.y, down}, down / to_next.z}; // f cos follows the cosine, to_next.z
    };
    const auto swapped = [](glm::vec2 d) { return glm::vec2(d.y, d.x); };
    return wide ? std::array{turn(outward), turn(around)}
                : std::array{turn(swapped(around)), turn(swapped(outward))};
}

} // namespace

Differentiation::Differentiation(const Differentiation& other) {
    *this = other;
}

Differentiation& Differentiation::operator=(const Differentiation& other) {
    here_.count = other.here_.count;
    here_.normal = other.here_.normal;
    here_.chance = other.here_.chance;
    here_.numbers = other.here_.numbers;
    const auto count = static_cast<std::ptrdiff_t>(NumberVectors::padded(here_.count));
    const auto copy = [&](const auto& from, auto& to) { std::copy_n(from.begin(), count, to.begin()); };
    for (const auto part : {&NumberVectors::x, &NumberVectors::y, &NumberVectors::z}) {
        copy(other.here_.position.*part, here_.position.*part);
        copy(other.direction_.*part, direction_.*part);
    }
    copy(other.here_.gradient, here_.gradient);
    copy(other.here_.choice, here_.choice);
    return *this;
}

void Differentiation::add_numbers(float choice, const std::array<Turn, 2>& turns) {
    for (const Turn& t : turns) {
        if (here_.count % NumberVectors::lanes == 0) // begins another SIMD vector: all its lanes must be 0
            for (auto* part : {&here_.position.x, &here_.position.y, &here_.position.z, &direction_.x,
                               &direction_.y, &direction_.z, &here_.gradient, &here_.choice})
                std::fill_n(part->begin() + here_.count, NumberVectors::lanes, 0.0f);
        const int j = here_.count++;
        direction_.set(j, t.direction);
        here_.gradient[j] = t.log_value;
        here_.choice[j] = choice;
    }
    here_.numbers = here_.count;
}

void Differentiation::start(const Projection& projection, glm::vec2 pixel, glm::vec2 lens) {
    here_.count = 0;
    here_.chance = 1;
    const std::array<Ray, 2> by = projection.ray_derivatives(pixel, lens);
    add_numbers(1, {Turn{by[0].direction, 0}, Turn{by[1].direction, 0}});
    here_.position.set(0, by[0].origin);
    here_.position.set(1, by[1].origin);
}

void Differentiation::arrive(const Ray& ray, float distance, glm::vec3 normal) {
    here_.normal = normal;
    const glm::vec3 d = ray.direction, slope = normal / glm::dot(d, normal);
    NumberVectors& p = here_.position;
    const auto count = static_cast<std::size_t>(NumberVectors::padded(here_.count));
    for (std::size_t j = 0; j < count; ++j) {
        const float x = p.x[j] + distance * direction_.x[j], y = p.y[j] + distance * direction_.y[j],
                    z = p.z[j] + distance * direction_.z[j];
        const float later = x * slope.x + y * slope.y + z * slope.z; // -dt
        p.x[j] = x - later * d.x;
        p.y[j] = y - later * d.y;
        p.z[j] = z - later * d.z;
    }
}

void Differentiation::turn(const Turns& position, const Turns& direction) {
    const auto count = static_cast<std::size_t>(NumberVectors::padded(here_.count));
    const NumberVectors& p = here_.position;
    for (std::size_t j = 0; j < count; ++j) {
        const glm::vec3 by(p.x[j], p.y[j], p.z[j]), turned(direction_.x[j], direction_.y[j], direction_.z[j]);
        const float a = glm::dot(position.along[0], by), b = glm::dot(position.along[1], by),
                    c = glm::dot(direction.along[0], turned), d = glm::dot(direction.along[1], turned);
        const auto sum = [&](auto part) {
            return a * part(position.by[0]) + b * part(position.by[1]) + c * part(direction.by[0]) +
                   d * part(direction.by[1]);
        };
        direction_.x[j] = sum([](const Turn& t) { return t.direction.x; });
        direction_.y[j] = sum([](const Turn& t) { return t.direction.y; });
        direction_.z[j] = sum([](const Turn& t) { return t.direction.z; });
        here_.gradient[j] += sum([](const Turn& t) { return t.log_value; });
    }
}

/// Derivatives of a surface that scatters equally everywhere. Motion of the vertex rotates the frame. The next
/// direction rotates with it, and the incident direction rotates backwards relative to it.
void Differentiation::turn_with_frame(const ShapeRecord& shape, const Ray& ray, const Hit& hit, const Vertex& x,
                                      glm::vec3 next, const Turns& seen) {
    if (!is_curved(shape, hit))
        return turn({}, seen);
    const FrameTurns turns(shape, hit, x.frame);
    const Frame plane(here_.normal);
    Turns position{{plane.tangent, plane.bitangent}, {}};
    for (const std::size_t k : {0, 1}) {
        const glm::vec3 turn = turns.along(position.along[k]), back = -glm::cross(turn, ray.direction);
        position.by[k].direction = glm::cross(turn, next);
        for (const std::size_t m : {0, 1}) {
            const float by = glm::dot(seen.along[m], back);
            position.by[k].direction += by * seen.by[m].direction;
            position.by[k].log_value += by * seen.by[m].log_value;
        }
    }
    turn(position, seen);
}

void Differentiation::scatter(const Scene& scene, const Ray& ray, const Hit& hit, const Vertex& x,
                              const Scattering& s) {
    const ShapeRecord& shape = scene.record(hit.shape);
    const bool is_diffuse = is_plain_diffuse(x), has_textures = scatters_by_texture(shape);
    std::array<Turn, 2> own;
    float choice = 1;
    if (is_diffuse && !has_textures) {
        own = turns_of_cosine(s.u, s.to_next);
        for (Turn& t : own)
            t.direction = x.to_world(t.direction);
        turn_with_frame(shape, ray, hit, x, x.to_world(s.to_next), {});
    } else {
        MovedScatter moved(scene, ray, hit, x, s, has_textures);
        const Frame across(ray.direction);
        const Turns seen{{across.tangent, across.bitangent},
                         {moved.by_direction(across.tangent), moved.by_direction(across.bitangent)}};
        if (has_textures) {
            const Frame plane(x.geometric_normal);
            turn({{plane.tangent, plane.bitangent},
                  {moved.by_position(plane.tangent), moved.by_position(plane.bitangent)}},
                 seen);
        } else {
            turn_with_frame(shape, ray, hit, x, x.to_world(s.to_next), seen);
        }
        if (!s.is_delta) {
            own = {moved.by_number({1, 0}), moved.by_number({0, 1})};
            if (sample_cosine_hemisphere(s.u) == s.to_next) // a diffuse lobe of another BSDF
                for (const std::size_t k : {0, 1})
                    own[k].direction = x.to_world(turns_of_cosine(s.u, s.to_next)[k].direction);
            // `area` is 1 / pdf of the lobe alone, and pdf_w that of all lobes: P = pdf_w |dD/dx x dD/dy|.
            const float area = glm::length(glm::cross(own[0].direction, own[1].direction));
            choice = area > 0 ? std::min(area * s.pdf_w, 1.0f) : 1;
        }
    }
    here_.chance *= s.survival * (s.is_delta ? s.pdf_w : choice);
    if (!s.is_delta)
        add_numbers(choice, own);
}

} // namespace tessera
