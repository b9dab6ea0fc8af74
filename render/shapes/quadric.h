#pragma once

#include "render/sampling/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace tessera {

/// A sphere, disk or cylinder under an affine map, intersected in closed form. In its own space the shape has
/// radius 1: the sphere about the origin, the disk in the plane z = 0, and the side of the cylinder about the z
/// axis from z = 0 to 1. Points and vectors called "local" are in that space. As in Mitsuba 3, u and v are
/// phi / 2 pi and theta / pi (sphere), radius and phi / 2 pi (disk), phi / 2 pi and z (cylinder).
class Quadric {
public:
    enum class Kind : std::uint8_t { sphere, disk, cylinder };

    /// The front of a sphere and a cylinder is outside, and the front of a disk faces +z. As in Mitsuba 3, a
    /// mirrored `to_world` turns the front of a sphere inside.
    /// @param to_world      affine, from the own space to the world or to the space of a ShapeGroup
    /// @param flip_normals  exchanges front and back
    /// Throws std::runtime_error if `to_world` has no inverse, or values that are not finite. A disk needs no
    /// extent along z.
    Quadric(Kind kind, const glm::mat4& to_world, bool flip_normals);

    Kind kind() const { return kind_; }
    bool has_front_inside() const { return side_ < 0; } ///< of a disk: front toward -z
    const glm::mat4& to_world() const { return to_world_; }
    bool is_curved() const { return kind_ != Kind::disk; }

    /// A point in which a ray meets the shape.
    struct Hit {
        double distance;
        glm::vec3 local;
    };
    /// Writes all points on the line origin + distance * direction, nearest first, and returns their number.
    int intersect(glm::vec3 origin, glm::vec3 direction, std::array<Hit, 2>& hits) const;

    /// A box around the shape, not empty.
    struct Bounds {
        glm::vec3 low, high;
    };
    Bounds bounds() const;
    double area() const { return area_; }

    glm::vec3 position(glm::vec3 local) const { return glm::vec3(to_world_ * glm::vec4(local, 1)); }
    glm::vec3 vector(glm::vec3 local) const { return glm::mat3(to_world_) * local; }
    /// Returns the unit normal on the front side.
    glm::vec3 normal(glm::vec3 local) const { return glm::normalize(scaled_normal(local)); }
    /// Returns the normal times a positive factor; linear in `local` on a curved shape.
    glm::vec3 scaled_normal(glm::vec3 local) const { return side_ * (to_normals_ * gradient(local)); }
    glm::vec2 uv(glm::vec3 local) const;
    /// Returns the local derivatives of the point by u and v. At a pole u has the direction of phi = 0.
    std::array<glm::vec3, 2> derivatives(glm::vec3 local) const;
    /// Returns a point near the shape moved onto it.
    glm::vec3 onto_surface(glm::vec3 local) const;

    /// Returns the pdf per area, in the space of `to_world`, of a point that is uniform in the own space.
    float pdf_a(glm::vec3 local) const {
        return 1 / (local_area() * area_scale_ * glm::length(to_normals_ * gradient(local)));
    }
    float local_area() const { return kind_ == Kind::sphere ? 4 * pi : kind_ == Kind::disk ? pi : 2 * pi; }

    /// Returns whether the shape is a sphere in the space of `to_world`, too, with its front outside. Emitter
    /// sampling then draws directions of the cone that it subtends.
    bool is_ball() const { return radius_ > 0 && side_ > 0; }
    glm::vec3 center() const { return glm::vec3(to_world_[3]); }
    float radius() const { return radius_; } ///< of a sphere; 0 if it is an ellipsoid
    /// Returns the squared sine of the angle between axis and rim of the cone; 1 from inside.
    float sine2_from(float distance2) const { return std::min(radius_ * radius_ / distance2, 1.0f); }
    /// Returns 1 - cosine of that angle: the solid angle over 2 pi.
    static float cone_height(float sine2) { return sine2 / (1 + std::sqrt(1 - sine2)); }
    /// Returns the pdf per solid angle of directions that are uniform in the cone. @param from  outside
    float cone_pdf_w(glm::vec3 from) const {
        const glm::vec3 d = center() - from;
        return 1 / (2 * pi * cone_height(sine2_from(glm::dot(d, d))));
    }

private:
    Kind kind_;
    float side_;       // 1: front outside or toward +z, -1: the other side
    float radius_ = 0; // of a sphere
    float area_scale_; // area over local area is |to_normals_ * gradient| times this
    double area_;
    glm::mat4 to_world_;
    glm::mat3 to_normals_; // transforms gradients; its largest element is 1
    glm::dmat4 to_local_;

    glm::vec3 gradient(glm::vec3 local) const {
        return kind_ == Kind::sphere ? local
               : kind_ == Kind::disk ? glm::vec3(0, 0, 1)
                                     : glm::vec3(local.x, local.y, 0);
    }
    double measured_area() const;
};

} // namespace tessera
