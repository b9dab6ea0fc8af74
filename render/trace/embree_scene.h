// What the intersector holds of Embree, for its own files alone.
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

/// The first exception of what Embree calls in the middle of its work, from any of its threads. Embree's interface
/// is C, through which nothing may be thrown: it is kept until Embree has returned.
class KeptException {
public:
    void keep(std::exception_ptr exception) noexcept {
        const std::lock_guard lock(mutex_);
        if (!first_)
            first_ = std::move(exception);
    }
    void throw_kept() const {
        const std::lock_guard lock(mutex_);
        if (first_)
            std::rethrow_exception(first_);
    }

private:
    mutable std::mutex mutex_;
    std::exception_ptr first_;
};

/// A surface that not all light meets.
struct Mask {
    const Mesh* mesh;
    const Texture* opacity;
};

struct Intersector::Impl {
    std::atomic<std::ptrdiff_t> bytes = 0; // written by the threads that build
    KeptException kept;                    // likewise
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<std::unique_ptr<Mask>> masks; // Embree has their addresses
    std::vector<RTCScene> groups;
    unsigned first_instance = 0;            // the geometries before it are shapes
    std::vector<GroupPlacement> placements; // of the instances
    std::vector<unsigned> first_shape;      // of each instance's group, as hits count

    ~Impl() {
        for (RTCScene group : groups)
            rtcReleaseScene(group);
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }

    bool has_instances() const { return !placements.empty(); }
    void start();
    RTCScene scene_of(const std::vector<Shape>& shapes, const std::vector<const Texture*>& opacities,
                      std::size_t first);
    void add_instances(const std::deque<ShapeGroup>& shape_groups, const std::vector<Instance>& instances,
                       const std::vector<const Texture*>& opacities);
};

/// Of a ray on its way in, where there are instances: what it is told apart by in the spaces of their groups.
inline std::uint32_t ray_number(glm::vec3 origin, glm::vec3 direction) {
    std::uint64_t key = 0;
    for (const float number : {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z})
        key = Random::mix(key ^ std::bit_cast<std::uint32_t>(number));
    return static_cast<std::uint32_t>(key);
}

/// Normalises the cross product of a triangle's edges, whose square may be beyond floats.
inline glm::vec3 unit(glm::vec3 n) {
    const float square = glm::dot(n, n);
    if (square > 1e-30f && square < 1e30f)
        return n * (1 / std::sqrt(square));
    return glm::vec3(glm::normalize(glm::dvec3(n)));
}

} // namespace tessera
