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

/// Reports the progress of the BVHs that the calling thread builds during the monitor's lifetime. It is found
/// through the thread, because many layers lie between loading a scene and building its BVH.
class BuildMonitor {
public:
    /// Receives the progress of a BVH, in [0, 1], from any of the building threads, also from several at once.
    /// Returns whether to continue; after false, the constructor of Intersector throws std::runtime_error.
    using Watch = std::function<bool(double progress)>;

    explicit BuildMonitor(Watch watch);
    ~BuildMonitor();
    BuildMonitor(const BuildMonitor&) = delete;
    BuildMonitor& operator=(const BuildMonitor&) = delete;

    /// Returns the calling thread's newest monitor, or null.
    static const BuildMonitor* current();
    bool is_wanted(double progress) const { return watch_(progress); }

private:
    Watch watch_;
    const BuildMonitor* outer_; // the thread's newest monitor before this one
};

struct Texture;

/// Transform of an instance from its group's space to the world.
struct GroupPlacement {
    glm::mat4 to_world;
    glm::mat3 of_normals; ///< normal_matrix of to_world, up to a positive factor

    glm::vec3 point(glm::vec3 p) const { return glm::vec3(to_world * glm::vec4(p, 1)); }
    glm::vec3 vector(glm::vec3 v) const { return glm::mat3(to_world) * v; }
    /// Returns a positive number if a direction in the group's space lies on the side of `world_normal`.
    float side(glm::vec3 in_group, glm::vec3 world_normal) const {
        return glm::dot(vector(in_group), world_normal);
    }
};

struct Hit {
    std::uint32_t shape; ///< index: first the scene's own shapes, then those of each group
    std::uint32_t triangle;
    glm::vec2 barycentric;           ///< weights of the second and third corner
    float distance;                  ///< from the ray's origin, in scene units
    glm::vec3 geometric_normal;      ///< unit; points to the side that sees the corners counter-clockwise in mesh
                                     ///< space, or to the front of a quadric
    const GroupPlacement* placement; ///< of the instance that was hit; null: the shape is in world space
    glm::vec3 local; ///< point of a quadric in its own space; `triangle` and `barycentric` are then unused
};

/// A segment that is tested for occlusion, without its end points.
struct Segment {
    glm::vec3 from;
    glm::vec3 to;
};

/// Intersects rays with a scene. Only this class uses Embree. A ray hits a surface with the probability of its
/// opacity. The random number is a hash of the ray, so equal rays have equal hits. Rays that are not finite are
/// rejected, because some builds of Embree abort the process on them.
class Intersector {
public:
    Intersector();
    /// Builds the BVHs. Keeps pointers to meshes, quadrics and textures. Throws std::runtime_error with Embree's
    /// message, or OutOfMemory if the BVH does not fit.
    /// @param opacities  by Hit::shape: the opacity (luminance) of the shape; null: opaque. Empty: all shapes are
    ///                   opaque.
    explicit Intersector(const std::vector<Shape>& shapes, const std::vector<const Texture*>& opacities = {},
                         const std::deque<ShapeGroup>& groups = {}, const std::vector<Instance>& instances = {});
    ~Intersector();
    Intersector(Intersector&&) noexcept;
    Intersector& operator=(Intersector&&) noexcept;

    /// Finds the first surface on the ray and stores it in `hit`. Returns false, and leaves `hit` unchanged, if
    /// there is none or the ray is not finite.
    bool closest(const Ray& ray, Hit& hit) const;

    /// Returns whether a surface intersects the segment. A segment that is not finite counts as occluded.
    bool occluded(const Segment& segment) const;

    /// Returns the bytes that Embree holds for BVHs and copies of triangles.
    std::size_t bytes() const;

    /// Moves a point off its surface toward the side of `direction`, by some hundred units in the last place, so
    /// that a ray from there does not hit the surface [after Waechter and Binder, Ray Tracing Gems, ch. 6]. The
    /// step of a coordinate near zero is relative to the scene's size, because the error of a hit's position is
    /// some units in the last place of the ray's origin and length.
    glm::vec3 off_surface(glm::vec3 position, glm::vec3 geometric_normal, glm::vec3 direction) const {
        const float step = std::copysign(1.0f / 65536, glm::dot(geometric_normal, direction));
        return position + step * geometric_normal * glm::max(glm::abs(position), smallest_coordinate_);
    }

    /// Tests `count` segments in packets, which is fast if they are coherent. Tests only the lanes that `asked`
    /// selects; the others are set to "not blocked".
    void occluded(const SegmentLanes& segments, const LaneMask& asked, int count, LaneMask& blocked) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    float smallest_coordinate_ = 0; // lower bound on |coordinate| in off_surface()
};

} // namespace tessera
