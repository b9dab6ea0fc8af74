// How the intersector's BVHs come about: shapes, groups and instances on their way into Embree, and what may go
// wrong.

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
        return; // by the monitor: see build()
    try {
        if (code == RTC_ERROR_OUT_OF_MEMORY)
            throw OutOfMemory("there is not enough memory for the BVH");
        throw std::runtime_error("Embree error " + std::to_string(static_cast<int>(code)) + ": " +
                                 (text ? text : ""));
    } catch (...) { // or there is no memory for the message
        static_cast<KeptException*>(kept)->keep(std::current_exception());
    }
}

/// Embree tells what it is about to allocate, and what it has freed.
bool count_bytes(void* sum, ssize_t bytes, bool) noexcept {
    *static_cast<std::atomic<std::ptrdiff_t>*>(sum) += bytes;
    return true;
}

/// What a monitor is told, and whether it has ended the build.
struct BuildState {
    const BuildMonitor* monitor;
    KeptException& kept;
    std::atomic<bool> given_up = false;
};

bool tell_monitor(void* state, double share) noexcept {
    BuildState& s = *static_cast<BuildState*>(state);
    try {
        if (!s.monitor->is_wanted(std::clamp(share, 0.0, 1.0)))
            throw std::runtime_error("building the BVH was given up");
    } catch (...) {
        s.kept.keep(std::current_exception());
        s.given_up = true;
    }
    return !s.given_up;
}

/// Builds the BVH; `kept` has an exception if that went wrong or is wanted no more.
void build(RTCScene scene, KeptException& kept) {
    BuildState state{BuildMonitor::current(), kept};
    if (state.monitor)
        rtcSetSceneProgressMonitorFunction(scene, tell_monitor, &state);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
}

float chance_of(std::uint64_t key) {
    return static_cast<float>(key >> 40) * 0x1p-24f;
}

/// A number in [0, 1) that depends on every bit of a ray's direction and of where it meets the surface.
float chance(glm::vec3 direction, glm::vec2 barycentric, unsigned shape, unsigned triangle) {
    const auto bits = [](float a, float b) {
        return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b);
    };
    std::uint64_t key = Random::mix(bits(direction.x, direction.y));
    key = Random::mix(key ^ bits(direction.z, barycentric.x));
    return chance_of(Random::mix(key ^ bits(barycentric.y, 0) ^ (std::uint64_t{shape} << 20) ^ triangle));
}

/// The same of a surface in an instance. There the ray has been taken into another space, with a rounding that is
/// not alike for single rays and packets: what counts is the ray as it was.
float chance(std::uint32_t ray_number, unsigned instance, unsigned shape, unsigned triangle) {
    const std::uint64_t key = Random::mix(std::uint64_t{ray_number} << 32 | instance);
    return chance_of(Random::mix(key ^ (std::uint64_t{shape} << 32) ^ triangle));
}

/// Of the ray and hit i of those that a filter is asked about.
float chance(const RTCFilterFunctionNArguments& a, unsigned i, glm::vec2 barycentric) {
    const unsigned shape = RTCHitN_geomID(a.hit, a.N, i), triangle = RTCHitN_primID(a.hit, a.N, i);
    const unsigned instance = RTCHitN_instID(a.hit, a.N, i, 0);
    if (instance != RTC_INVALID_GEOMETRY_ID)
        return chance(RTCRayN_id(a.ray, a.N, i), instance, shape, triangle);
    const glm::vec3 direction(RTCRayN_dir_x(a.ray, a.N, i), RTCRayN_dir_y(a.ray, a.N, i),
                              RTCRayN_dir_z(a.ray, a.N, i));
    return chance(direction, barycentric, shape, triangle);
}

/// Lets rays through a mask.
void filter(const RTCFilterFunctionNArguments* arguments) {
    const Mask& mask = *static_cast<const Mask*>(arguments->geometryUserPtr);
    const unsigned count = arguments->N;
    for (unsigned i = 0; i < count; ++i) {
        if (arguments->valid[i] != -1)
            continue;
        const glm::vec2 barycentric(RTCHitN_u(arguments->hit, count, i), RTCHitN_v(arguments->hit, count, i));
        const unsigned triangle = RTCHitN_primID(arguments->hit, count, i);
        const float opacity = luminance(mask.opacity->evaluate(surface_point(*mask.mesh, triangle, barycentric)));
        if (chance(*arguments, i, barycentric) >= opacity)
            arguments->valid[i] = 0;
    }
}

/// Hands a mesh's arrays to Embree, which reads 16 bytes where a position has 12: where the last one is not
/// followed by memory of the vector's own, Embree gets a copy, which it pads.
void set_buffers(RTCGeometry geometry, const Mesh& mesh) {
    if (mesh.positions.capacity() > mesh.positions.size()) {
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(),
                                   0, sizeof(glm::vec3), mesh.positions.size());
    } else {
        auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
        if (positions) // else Embree has told of an error
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

/// What Embree takes while it builds, which is more than what it keeps: measured on up to 4 million triangles, 105
/// bytes for each of a smooth surface and 134 for each of a soup, of which 72 and 101 remain.
constexpr std::uint64_t build_bytes_a_triangle = 136;

/// The same of an instance: 370 bytes were measured.
constexpr std::uint64_t build_bytes_an_instance = 512;

void ask_for_build(const std::vector<Shape>& shapes, const std::deque<ShapeGroup>& groups, std::size_t instances) {
    std::uint64_t triangles = 0;
    const auto add = [&](const std::vector<Shape>& of) {
        for (const Shape& shape : of)
            triangles += shape.mesh.triangles.size();
    };
    add(shapes);
    for (const ShapeGroup& group : groups)
        add(group.shapes);
    ask_for_memory(triangles * build_bytes_a_triangle + instances * build_bytes_an_instance,
                   std::to_string(triangles) + " triangles in a BVH");
}

float largest_component(glm::vec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The largest magnitudes of coordinates, x, y and z.
glm::vec3 extents(const std::vector<Shape>& shapes) {
    glm::vec3 largest(0);
    for (const Shape& shape : shapes)
        for (glm::vec3 p : shape.mesh.positions)
            largest = glm::max(largest, glm::abs(p));
    return largest;
}

/// Of the matrix that takes normals along only the directions count: its largest element is 1, as the cofactors of
/// something tiny are tinier still.
glm::mat3 placed_normals(const glm::mat4& to_world) {
    const glm::mat3 m = normal_matrix(glm::mat3(to_world));
    return m / std::max({largest_component(m[0]), largest_component(m[1]), largest_component(m[2])});
}

/// What counts for the rounding of a hit in an instance: the magnitudes of all that its coordinates are summed of.
float extent(const Instance& instance, glm::vec3 of_group) {
    glm::vec3 sum = glm::abs(glm::vec3(instance.to_world[3]));
    for (int axis = 0; axis < 3; ++axis)
        sum += glm::abs(glm::vec3(instance.to_world[axis])) * of_group[axis];
    return largest_component(sum);
}

} // namespace

void Intersector::Impl::start() {
    // Embree's 512-bit kernels trace single rays some 4 % slower than its 256-bit ones (measured on an EPYC).
    device = rtcNewDevice("max_isa=avx2");
    if (!device)
        throw std::runtime_error("Embree did not start");
    rtcSetDeviceErrorFunction(device, on_error, &kept);
    rtcSetDeviceMemoryMonitorFunction(device, count_bytes, &bytes);
}

/// Builds a scene of shapes. The first of them is number `first` among the opacities.
RTCScene Intersector::Impl::scene_of(const std::vector<Shape>& shapes,
                                     const std::vector<const Texture*>& opacities, std::size_t first) {
    RTCScene made = rtcNewScene(device);
    rtcSetSceneBuildQuality(made, RTC_BUILD_QUALITY_MEDIUM);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        Mask* mask = nullptr;
        if (first + i < opacities.size() && opacities[first + i])
            mask = masks.emplace_back(new Mask{&shapes[i].mesh, opacities[first + i]}).get();
        attach(device, made, shapes[i].mesh, mask, static_cast<unsigned>(i));
    }
    return made;
}

/// Builds the groups, each on its own, and puts them into the scene as its instances say.
void Intersector::Impl::add_instances(const std::deque<ShapeGroup>& shape_groups,
                                      const std::vector<Instance>& instances,
                                      const std::vector<const Texture*>& opacities) {
    std::vector<unsigned> first_of_group;
    unsigned first = first_instance;
    for (const ShapeGroup& group : shape_groups) {
        groups.push_back(scene_of(group.shapes, opacities, first));
        kept.throw_kept();
        build(groups.back(), kept);
        kept.throw_kept();
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
    impl_->kept.throw_kept(); // there is no building from what Embree has refused
    build(impl_->scene, impl_->kept);
    impl_->kept.throw_kept();
    std::vector<glm::vec3> of_groups;
    for (const ShapeGroup& group : groups)
        of_groups.push_back(extents(group.shapes));
    float largest = largest_component(extents(shapes));
    for (const Instance& instance : instances)
        largest = std::max(largest, extent(instance, of_groups[instance.group]));
    smallest_coordinate_ = largest / 8;
}

} // namespace tessera
