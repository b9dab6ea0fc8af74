// Builds the intersector's BVHs from shapes, groups and instances.

#include "render/io/available_memory.h"
#include "render/sampling/sampling.h"
#include "render/surface/texture.h"
#include "render/trace/embree_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>

namespace tessera {

namespace {
thread_local const BuildMonitor* newest = nullptr;
} // namespace

BuildMonitor::BuildMonitor(Watch watch) : watch_(std::move(watch)), outer_(newest) {
    newest = this;
}

BuildMonitor::~BuildMonitor() {
    newest = outer_;
}

const BuildMonitor* BuildMonitor::current() {
    return newest;
}

namespace {

void on_error(void* kept, RTCError code, const char* text) noexcept {
    if (code == RTC_ERROR_CANCELLED)
        return; // tell_monitor() has kept the exception
    try {
        if (code == RTC_ERROR_OUT_OF_MEMORY)
            throw OutOfMemory("there is not enough memory for the BVH");
        throw std::runtime_error("Embree error " + std::to_string(static_cast<int>(code)) + ": " +
                                 (text ? text : ""));
    } catch (...) { // includes std::bad_alloc of the message
        static_cast<KeptException*>(kept)->keep(std::current_exception());
    }
}

/// Counts Embree's memory: Embree reports each allocation before it, and each deallocation after it.
bool count_bytes(void* sum, ssize_t bytes, bool) noexcept {
    *static_cast<std::atomic<std::ptrdiff_t>*>(sum) += bytes;
    return true;
}

/// A build with its monitor.
struct BuildState {
    const BuildMonitor* monitor;
    KeptException& kept;
    std::atomic<bool> cancelled = false;
};

bool tell_monitor(void* state, double progress) noexcept {
    BuildState& s = *static_cast<BuildState*>(state);
    try {
        if (!s.monitor->is_wanted(std::clamp(progress, 0.0, 1.0)))
            throw std::runtime_error("building the BVH was cancelled");
    } catch (...) {
        s.kept.keep(std::current_exception());
        s.cancelled = true;
    }
    return !s.cancelled;
}

/// Builds the BVH. Stores an exception in `kept` if the build fails or its monitor cancels it.
void build(RTCScene scene, KeptException& kept) {
    BuildState state{BuildMonitor::current(), kept};
    if (state.monitor)
        rtcSetSceneProgressMonitorFunction(scene, tell_monitor, &state);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
}

/// Returns a number in [0, 1) from the high bits of a hash.
float chance_of(std::uint64_t key) {
    return static_cast<float>(key >> 40) * 0x1p-24f;
}

/// Returns a random number in [0, 1): a hash of a ray's direction and of its hit.
float chance(glm::vec3 direction, glm::vec2 barycentric, unsigned shape, unsigned triangle) {
    const auto bits = [](float a, float b) {
        return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b);
    };
    std::uint64_t key = Random::mix(bits(direction.x, direction.y));
    key = Random::mix(key ^ bits(direction.z, barycentric.x));
    return chance_of(Random::mix(key ^ bits(barycentric.y, 0) ^ (std::uint64_t{shape} << 20) ^ triangle));
}

/// Returns the random number for a surface in an instance. It is a hash of the ray in world space, because the ray
/// in the group's space is rounded differently for single rays and packets.
float chance(std::uint32_t ray_number, unsigned instance, unsigned shape, unsigned triangle) {
    const std::uint64_t key = Random::mix(std::uint64_t{ray_number} << 32 | instance);
    return chance_of(Random::mix(key ^ (std::uint64_t{shape} << 32) ^ triangle));
}

} // namespace

float chance_of_hit(RTCRayN* rays, unsigned count, unsigned i, unsigned instance, unsigned shape,
                    unsigned triangle, glm::vec2 at) {
    if (instance != RTC_INVALID_GEOMETRY_ID)
        return chance(RTCRayN_id(rays, count, i), instance, shape, triangle);
    const glm::vec3 direction(RTCRayN_dir_x(rays, count, i), RTCRayN_dir_y(rays, count, i),
                              RTCRayN_dir_z(rays, count, i));
    return chance(direction, at, shape, triangle);
}

namespace {

/// Embree filter of masks: rejects a hit with the probability 1 - opacity.
void filter(const RTCFilterFunctionNArguments* arguments) {
    const Mask& mask = *static_cast<const Mask*>(arguments->geometryUserPtr);
    const unsigned count = arguments->N;
    for (unsigned i = 0; i < count; ++i) {
        if (arguments->valid[i] != -1)
            continue;
        const glm::vec2 barycentric(RTCHitN_u(arguments->hit, count, i), RTCHitN_v(arguments->hit, count, i));
        const unsigned triangle = RTCHitN_primID(arguments->hit, count, i);
        const unsigned instance = RTCHitN_instID(arguments->hit, count, i, 0);
        const unsigned shape = RTCHitN_geomID(arguments->hit, count, i);
        const float opacity = luminance(mask.opacity->evaluate(surface_point(*mask.mesh, triangle, barycentric)));
        if (chance_of_hit(arguments->ray, count, i, instance, shape, triangle, barycentric) >= opacity)
            arguments->valid[i] = 0;
    }
}

/// Shares a mesh's arrays with Embree. Embree reads 16 bytes for each position of 12 bytes. If the vector has no
/// spare capacity behind its last position, Embree gets a padded copy.
void set_buffers(RTCGeometry geometry, const Mesh& mesh) {
    if (mesh.positions.capacity() > mesh.positions.size()) {
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(),
                                   0, sizeof(glm::vec3), mesh.positions.size());
    } else {
        auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
        if (positions) // null: Embree has reported an error
            std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
    }
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                               sizeof(glm::uvec3), mesh.triangles.size());
}

void attach(RTCDevice device, RTCScene scene, const Mesh& mesh, Mask* mask, unsigned id) {
    if (mesh.triangles.empty())
        return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    set_buffers(geometry, mesh);
    if (mask) {
        rtcSetGeometryUserData(geometry, mask);
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
        rtcSetGeometryOccludedFilterFunction(geometry, filter);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
}

// Upper bounds on Embree's memory during a build, which is more than the finished BVH holds. Those of triangles
// and instances are measured. That of a quadric is not tuned: 100,000 spheres take less.
constexpr std::uint64_t build_bytes_a_triangle = 136;
constexpr std::uint64_t build_bytes_an_instance = 512;
constexpr std::uint64_t build_bytes_a_quadric = 2048;

/// Throws OutOfMemory if there is too little memory for the build.
void ask_for_build(const std::vector<Shape>& shapes, const std::deque<ShapeGroup>& groups, std::size_t instances) {
    std::uint64_t triangles = 0, quadrics = 0;
    const auto add = [&](const std::vector<Shape>& added) {
        for (const Shape& shape : added) {
            triangles += shape.mesh.triangles.size();
            quadrics += shape.quadric.has_value();
        }
    };
    add(shapes);
    for (const ShapeGroup& group : groups)
        add(group.shapes);
    require_memory(triangles * build_bytes_a_triangle + quadrics * build_bytes_a_quadric +
                       instances * build_bytes_an_instance,
                   std::to_string(triangles) + " triangles in a BVH");
}

float largest_component(glm::vec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Returns the largest magnitude of each coordinate.
glm::vec3 extents(const std::vector<Shape>& shapes) {
    glm::vec3 largest(0);
    for (const Shape& shape : shapes) {
        for (glm::vec3 p : shape.mesh.positions)
            largest = glm::max(largest, glm::abs(p));
        if (shape.quadric) {
            const Quadric::Bounds box = shape.quadric->bounds();
            largest = glm::max(largest, glm::max(glm::abs(box.low), glm::abs(box.high)));
        }
    }
    return largest;
}

/// Returns the normal matrix of a placement, scaled so that its largest element is 1. The cofactors of a small
/// transform could underflow in later products.
glm::mat3 placed_normals(const glm::mat4& to_world) {
    const glm::mat3 m = normal_matrix(glm::mat3(to_world));
    return m / std::max({largest_component(m[0]), largest_component(m[1]), largest_component(m[2])});
}

/// Returns a bound on the terms whose sum is a world coordinate of a hit in an instance. It bounds the rounding
/// error of the hit's position.
/// @param group_extents  extents() of the instance's group
float extent(const Instance& instance, glm::vec3 group_extents) {
    glm::vec3 sum = glm::abs(glm::vec3(instance.to_world[3]));
    for (int axis = 0; axis < 3; ++axis)
        sum += glm::abs(glm::vec3(instance.to_world[axis])) * group_extents[axis];
    return largest_component(sum);
}

} // namespace

void Intersector::Impl::start() {
    // Embree traces single rays about 4 % slower with its 512-bit kernels than with its 256-bit ones.
    device = rtcNewDevice("max_isa=avx2");
    if (!device)
        throw std::runtime_error("Embree did not start");
    rtcSetDeviceErrorFunction(device, on_error, &kept);
    rtcSetDeviceMemoryMonitorFunction(device, count_bytes, &bytes);
}

/// Creates an Embree scene of shapes, without its BVH. `opacities[first]` belongs to the first shape.
RTCScene Intersector::Impl::scene_of(const std::vector<Shape>& shapes,
                                     const std::vector<const Texture*>& opacities, std::size_t first) {
    RTCScene made = rtcNewScene(device);
    rtcSetSceneBuildQuality(made, RTC_BUILD_QUALITY_MEDIUM);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const Texture* opacity = first + i < opacities.size() ? opacities[first + i] : nullptr;
        const auto id = static_cast<unsigned>(i);
        if (shapes[i].quadric) {
            quadric_of.resize(std::max(quadric_of.size(), first + i + 1));
            quadric_of[first + i] = &*shapes[i].quadric;
            attach(device, made, *quadrics.emplace_back(new QuadricGeometry{&*shapes[i].quadric, opacity}), id);
            continue;
        }
        Mask* mask = opacity ? masks.emplace_back(new Mask{&shapes[i].mesh, opacity}).get() : nullptr;
        attach(device, made, shapes[i].mesh, mask, id);
    }
    return made;
}

/// Builds one BVH for each group, and adds all instances to the scene.
void Intersector::Impl::add_instances(const std::deque<ShapeGroup>& shape_groups,
                                      const std::vector<Instance>& instances,
                                      const std::vector<const Texture*>& opacities) {
    std::vector<unsigned> first_of_group;
    unsigned first = first_instance;
    for (const ShapeGroup& group : shape_groups) {
        groups.push_back(scene_of(group.shapes, opacities, first));
        kept.rethrow();
        build(groups.back(), kept);
        kept.rethrow();
        first_of_group.push_back(first);
        first += static_cast<unsigned>(group.shapes.size());
    }
    for (const Instance& instance : instances) {
        const auto group = static_cast<std::size_t>(instance.group);
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, groups[group]);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &instance.to_world[0][0]);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, first_instance + static_cast<unsigned>(placements.size()));
        rtcReleaseGeometry(geometry);
        placements.push_back({instance.to_world, placed_normals(instance.to_world)});
        first_shape.push_back(first_of_group[group]);
    }
}

Intersector::Intersector(const std::vector<Shape>& shapes, const std::vector<const Texture*>& opacities,
                         const std::deque<ShapeGroup>& groups, const std::vector<Instance>& instances)
    : impl_(std::make_unique<Impl>()) {
    ask_for_build(shapes, groups, instances.size());
    impl_->start();
    impl_->scene = impl_->scene_of(shapes, opacities, 0);
    impl_->first_instance = static_cast<unsigned>(shapes.size());
    impl_->add_instances(groups, instances, opacities);
    impl_->kept.rethrow(); // Embree may have refused a geometry
    build(impl_->scene, impl_->kept);
    impl_->kept.rethrow();
    std::vector<glm::vec3> of_groups;
    for (const ShapeGroup& group : groups)
        of_groups.push_back(extents(group.shapes));
    float largest = largest_component(extents(shapes));
    for (const Instance& instance : instances)
        largest = std::max(largest, extent(instance, of_groups[instance.group]));
    smallest_coordinate_ = largest / 8;
}

} // namespace tessera
