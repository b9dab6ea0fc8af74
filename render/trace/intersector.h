#pragma once

#include "render/surface/mesh.h"
#include "render/trace/rays.h"

#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace tessera {

/// Tells a watch of the BVHs that the calling thread builds while this lives: whoever loads a scene is far from
/// where its BVH is built, and is the only one to watch.
class BuildMonitor {
public:
    /// It is told the share of a BVH that is done, [0, 1], by any of the threads that build it, several at once,
    /// and says whether to go on. False: the BVH is wanted no more, and its constructor throws std::runtime_error.
    using Watch = std::function<bool(double share)>;

    explicit BuildMonitor(Watch watch);
    ~BuildMonitor();
    BuildMonitor(const BuildMonitor&) = delete;
    BuildMonitor& operator=(const BuildMonitor&) = delete;

    /// The calling thread's newest monitor; null: it has none.
    static const BuildMonitor* current();
    bool is_wanted(double share) const { return watch_(share); }

private:
    Watch watch_;
    const BuildMonitor* outer_;
};

struct Texture;

/// Where an instance's group of shapes stands.
struct GroupPlacement {
    glm::mat4 to_world;
    glm::mat3 of_normals; ///< normal_matrix of to_world, times some number

    glm::vec3 point(glm::vec3 p) const { return glm::vec3(to_world * glm::vec4(p, 1)); }
    glm::vec3 vector(glm::vec3 v) const { return glm::mat3(to_world) * v; }
    /// Which side of the surface something in the group's space is on, by a normal of the scene: > 0, its own.
    float side(glm::vec3 in_group, glm::vec3 world_normal) const {
        return glm::dot(vector(in_group), world_normal);
    }
};

struct Hit {
    std::uint32_t shape; ///< those of the groups count on, group by group, where the scene's own end
    std::uint32_t triangle;
    glm::vec2 barycentric; ///< weights of the second and third corner
    float distance;        ///< along the unit direction of the ray
    glm::vec3
        geometric_normal; ///< unit, on the side from which the corners run counter-clockwise before placement
    const GroupPlacement* placement; ///< of the shape's mesh; null: it is in the space of the scene
};

/// A stretch of space that light must cross: open at both ends.
struct Segment {
    glm::vec3 from;
    glm::vec3 to;
};

/// The only place that knows Embree. A surface that is not opaque is there for one ray and not for another, by
/// chance in proportion to its opacity; the chance is a function of the ray, so that the same ray sees the same.
/// Every ray is checked on its way in: one that is not finite hits nothing (the Embree of Debian would end the
/// process).
class Intersector {
public:
    Intersector();
    /// @param opacities  one a shape, those of groups after the others: the share of light (luminance) that meets
    ///                   it; null: all does. May be empty: all shapes are opaque.
    ///
    /// Meshes and textures must stay where they are for as long as this lives. Throws std::runtime_error with
    /// what Embree says where it fails, OutOfMemory where the BVH cannot be had.
    explicit Intersector(const std::vector<Shape>& shapes, const std::vector<const Texture*>& opacities = {},
                         const std::deque<ShapeGroup>& groups = {}, const std::vector<Instance>& instances = {});
    ~Intersector();
    Intersector(Intersector&&) noexcept;
    Intersector& operator=(Intersector&&) noexcept;

    /// Makes `hit` the first triangle on the ray, beyond its origin. False: there is none.
    bool closest(const Ray& ray, Hit& hit) const;

    /// Whether anything stands between the ends of the segment.
    bool occluded(const Segment& segment) const;

    /// What Embree holds: the BVH and its own copy of the triangles.
    std::size_t bytes() const;

    /// A point moved off its surface by some hundred units in the last place, toward the side of `direction`: the
    /// end of a ray that must not meet the surface itself (after [Waechter and Binder, Ray Tracing Gems, ch. 6],
    /// with steps in proportion to the scene, so that its units do not matter). A hit's position has an error of
    /// some units in the last place of the ray's origin and length, also where the coordinate itself is near zero.
    glm::vec3 off_surface(glm::vec3 position, glm::vec3 geometric_normal, glm::vec3 direction) const {
        const float step = std::copysign(1.0f / 65536, glm::dot(geometric_normal, direction));
        return position + step * geometric_normal * glm::max(glm::abs(position), smallest_coordinate_);
    }

    /// Does as the other occluded() does for `count` segments that share one end or nearly so, in packets. Only
    /// lanes that are asked for are traced; the others are not blocked.
    void occluded(const SegmentLanes& segments, const LaneMask& asked, int count, LaneMask& blocked) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    float smallest_coordinate_ = 0; // what a step off a surface takes a coordinate for at least
};

} // namespace tessera
