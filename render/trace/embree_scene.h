// Embree's objects behind Intersector. Only the files of render/trace include this header.
#pragma once

#include "render/sampling/sampling.h"
#include "render/trace/intersector.h"

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#if TESSERA_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace tessera {

/// Keeps the first exception of Embree's callbacks, which run in any of its threads, until Embree has returned. An
/// exception must not pass through Embree's C functions.
class KeptException {
public:
    void keep(std::exception_ptr exception) noexcept {
        const std::lock_guard lock(mutex_);
        if (!first_)
            first_ = std::move(exception);
    }
    void rethrow() const {
        const std::lock_guard lock(mutex_);
        if (first_)
            std::rethrow_exception(first_);
    }

private:
    mutable std::mutex mutex_;
    std::exception_ptr first_;
};

/// User data of a mesh that is not opaque.
struct Mask {
    const Mesh* mesh;
    const Texture* opacity;
};

/// User data of a quadric.
struct QuadricGeometry {
    const Quadric* quadric;
    const Texture* opacity; ///< null: opaque
};

/// Adds a quadric to a scene as user geometry. A hit's normal is the point in the quadric's own space.
void attach(RTCDevice device, RTCScene scene, QuadricGeometry& quadric, unsigned id);

/// Returns a random number in [0, 1) for hit i of a packet, by which surfaces that are not opaque reject hits.
/// @param instance  RTC_INVALID_GEOMETRY_ID: none
/// @param at        coordinates of the hit on the surface
float chance_of_hit(RTCRayN* rays, unsigned count, unsigned i, unsigned instance, unsigned shape,
                    unsigned triangle, glm::vec2 at);

struct Intersector::Impl {
    std::atomic<std::ptrdiff_t> bytes = 0; // memory that Embree holds; written by Embree's threads
    KeptException kept;                    // written by Embree's threads
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<std::unique_ptr<Mask>> masks; // Embree keeps pointers to them
    std::vector<std::unique_ptr<QuadricGeometry>> quadrics;
    std::vector<const Quadric*> quadric_of; // by Hit::shape, null: a mesh; empty: there are no quadrics
    std::vector<RTCScene> groups;
    unsigned first_instance = 0;            // id of the first instance; smaller ids are shapes
    std::vector<GroupPlacement> placements; // by instance
    std::vector<unsigned> first_shape;      // by instance: Hit::shape of the first shape of its group

    ~Impl() {
        for (RTCScene group : groups)
            rtcReleaseScene(group);
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }

    bool has_instances() const { return !placements.empty(); }
    /// Returns the quadric of a Hit::shape; null: it is a mesh.
    const Quadric* quadric_at(std::uint32_t shape) const {
        return shape < quadric_of.size() ? quadric_of[shape] : nullptr;
    }
    void start();
    RTCScene scene_of(const std::vector<Shape>& shapes, const std::vector<const Texture*>& opacities,
                      std::size_t first);
    void add_instances(const std::deque<ShapeGroup>& shape_groups, const std::vector<Instance>& instances,
                       const std::vector<const Texture*>& opacities);
};

/// Returns a hash of a ray in world space. With instances it is the ray's id, by which the opacity filter
/// identifies the ray in the spaces of groups.
inline std::uint32_t ray_number(glm::vec3 origin, glm::vec3 direction) {
    std::uint64_t key = 0;
    for (const float number : {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z})
        key = Random::mix(key ^ std::bit_cast<std::uint32_t>(number));
    return static_cast<std::uint32_t>(key);
}

/// Normalises the cross product of a triangle's edges. Its square can overflow or underflow a float.
inline glm::vec3 unit(glm::vec3 n) {
    const float square = glm::dot(n, n);
    if (square > 1e-30f && square < 1e30f)
        return n * (1 / std::sqrt(square));
    return glm::vec3(glm::normalize(glm::dvec3(n)));
}

} // namespace tessera
