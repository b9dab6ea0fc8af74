#include "render/trace/intersector.h"

#include "render/io/available_memory.h"
#include "render/sampling/sampling.h"
#include "render/surface/texture.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#if TESSERA_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

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

constexpr int packet_size = 8;

/// Embree loses its footing far before floats end.
constexpr float farthest = 1e18f;

bool is_sound(glm::vec3 v) {
    // A NaN fails every comparison.
    return (std::abs(v.x) < farthest) & (std::abs(v.y) < farthest) & (std::abs(v.z) < farthest);
}

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

RTCRay make_ray(glm::vec3 origin, glm::vec3 direction, float tfar) {
    RTCRay ray;
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = 0;
    ray.tfar = tfar;
    ray.time = 0;
    ray.mask = ~0u;
    ray.id = 0;
    ray.flags = 0;
    return ray;
}

/// What is alike in all packets of stretches.
RTCRay8 empty_packet() {
    RTCRay8 packet;
    for (int lane = 0; lane < packet_size; ++lane) {
        packet.tnear[lane] = 0;
        packet.time[lane] = 0;
        packet.mask[lane] = ~0u;
        packet.id[lane] = 0;
        packet.flags[lane] = 0;
    }
    return packet;
}

/// Puts segment m into a lane of the packet. False: it is not fit to be traced.
bool set_ray(RTCRay8& packet, int lane, const SegmentLanes& s, int m) {
    packet.org_x[lane] = s.from.x[m];
    packet.org_y[lane] = s.from.y[m];
    packet.org_z[lane] = s.from.z[m];
    packet.dir_x[lane] = s.to.x[m] - s.from.x[m];
    packet.dir_y[lane] = s.to.y[m] - s.from.y[m];
    packet.dir_z[lane] = s.to.z[m] - s.from.z[m];
    packet.tfar[lane] = 1; // Embree marks what is blocked here
    return is_sound(s.from[m]) & is_sound(s.to[m]);
}

// The two versions of Embree differ in how a query is told its wishes.
#if TESSERA_EMBREE_MAJOR >= 4
void intersect(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray, nullptr);
}
void test_occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray, nullptr);
}
void test_occluded(RTCScene scene, const int* valid, RTCRay8& rays) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded8(valid, scene, &rays, &arguments);
}
#else
void intersect(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
}
void test_occluded(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
}
void test_occluded(RTCScene scene, const int* valid, RTCRay8& rays) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded8(valid, scene, &context, &rays);
}
#endif

/// Normalises the cross product of a triangle's edges, whose square may be beyond floats.
glm::vec3 unit(glm::vec3 n) {
    const float square = glm::dot(n, n);
    if (square > 1e-30f && square < 1e30f)
        return n * (1 / std::sqrt(square));
    return glm::vec3(glm::normalize(glm::dvec3(n)));
}

/// A surface that not all light meets.
struct Mask {
    const Mesh* mesh;
    const Texture* opacity;
};

/// A number in [0, 1) that depends on every bit of a ray's direction and of where it meets the surface.
float chance(glm::vec3 direction, glm::vec2 barycentric, unsigned shape, unsigned triangle) {
    const auto bits = [](float a, float b) {
        return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b);
    };
    std::uint64_t key = Random::mix(bits(direction.x, direction.y));
    key = Random::mix(key ^ bits(direction.z, barycentric.x));
    key = Random::mix(key ^ bits(barycentric.y, 0) ^ (std::uint64_t{shape} << 20) ^ triangle);
    return static_cast<float>(key >> 40) * 0x1p-24f;
}

/// Lets rays through a mask.
void filter(const RTCFilterFunctionNArguments* arguments) {
    const Mask& mask = *static_cast<const Mask*>(arguments->geometryUserPtr);
    const unsigned count = arguments->N;
    for (unsigned i = 0; i < count; ++i) {
        if (arguments->valid[i] != -1)
            continue;
        const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, count, i), RTCRayN_dir_y(arguments->ray, count, i),
                                  RTCRayN_dir_z(arguments->ray, count, i));
        const glm::vec2 barycentric(RTCHitN_u(arguments->hit, count, i), RTCHitN_v(arguments->hit, count, i));
        const unsigned triangle = RTCHitN_primID(arguments->hit, count, i);
        const float opacity = luminance(mask.opacity->evaluate(surface_point(*mask.mesh, triangle, barycentric)));
        if (chance(direction, barycentric, RTCHitN_geomID(arguments->hit, count, i), triangle) >= opacity)
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

void ask_for_build(const std::vector<Shape>& shapes) {
    std::uint64_t triangles = 0;
    for (const Shape& shape : shapes)
        triangles += shape.mesh.triangles.size();
    ask_for_memory(triangles * build_bytes_a_triangle, std::to_string(triangles) + " triangles in a BVH");
}

/// The largest magnitude of a coordinate.
float extent(const std::vector<Shape>& shapes) {
    float largest = 0;
    for (const Shape& shape : shapes)
        for (glm::vec3 p : shape.mesh.positions)
            largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return largest;
}

} // namespace

struct Intersector::Impl {
    std::atomic<std::ptrdiff_t> bytes = 0; // written by the threads that build
    KeptException kept;                    // likewise
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<std::unique_ptr<Mask>> masks; // Embree has their addresses

    ~Impl() {
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }
};

Intersector::Intersector() = default;
Intersector::~Intersector() = default;
Intersector::Intersector(Intersector&&) noexcept = default;
Intersector& Intersector::operator=(Intersector&&) noexcept = default;

Intersector::Intersector(const std::vector<Shape>& shapes, const std::vector<const Texture*>& opacities)
    : impl_(std::make_unique<Impl>()) {
    ask_for_build(shapes);
    // Embree's 512-bit kernels trace single rays some 4 % slower than its 256-bit ones (measured on an EPYC).
    impl_->device = rtcNewDevice("max_isa=avx2");
    if (!impl_->device)
        throw std::runtime_error("Embree did not start");
    rtcSetDeviceErrorFunction(impl_->device, on_error, &impl_->kept);
    rtcSetDeviceMemoryMonitorFunction(impl_->device, count_bytes, &impl_->bytes);
    impl_->scene = rtcNewScene(impl_->device);
    rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_MEDIUM);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        Mask* mask = nullptr;
        if (i < opacities.size() && opacities[i])
            mask = impl_->masks.emplace_back(new Mask{&shapes[i].mesh, opacities[i]}).get();
        attach(impl_->device, impl_->scene, shapes[i].mesh, mask, static_cast<unsigned>(i));
    }
    impl_->kept.throw_kept(); // there is no building from what Embree has refused
    build(impl_->scene, impl_->kept);
    impl_->kept.throw_kept();
    smallest_coordinate_ = extent(shapes) / 8;
}

bool Intersector::closest(const Ray& ray, Hit& hit) const {
    if (!is_sound(ray.origin) || !is_sound(ray.direction))
        return false;
    RTCRayHit query;
    query.ray = make_ray(ray.origin, ray.direction, std::numeric_limits<float>::infinity());
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(impl_->scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    hit.shape = query.hit.geomID;
    hit.triangle = query.hit.primID;
    hit.barycentric = {query.hit.u, query.hit.v};
    hit.distance = query.ray.tfar;
    hit.geometric_normal = unit({query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z});
    return true;
}

bool Intersector::occluded(const Segment& segment) const {
    if (!is_sound(segment.from) || !is_sound(segment.to))
        return true;
    RTCRay ray = make_ray(segment.from, segment.to - segment.from, 1);
    test_occluded(impl_->scene, ray);
    return ray.tfar < 0;
}

std::size_t Intersector::bytes() const {
    return impl_ ? static_cast<std::size_t>(std::max<std::ptrdiff_t>(impl_->bytes, 0)) : 0;
}

void Intersector::occluded(const SegmentLanes& segments, const LaneMask& asked, int count,
                           LaneMask& blocked) const {
    alignas(32) int valid[packet_size];
    alignas(32) RTCRay8 packet = empty_packet();
    for (int start = 0; start < count; start += packet_size) {
        bool any = false;
        for (int lane = 0; lane < packet_size; ++lane) {
            const int m = start + lane;
            const bool sound = set_ray(packet, lane, segments, m);
            const int wanted = m < count ? asked[m] : 0;
            valid[lane] = sound ? wanted : 0;
            blocked[m] = sound ? 0 : wanted;
            any |= valid[lane] != 0;
        }
        if (!any)
            continue;
        test_occluded(impl_->scene, valid, packet);
        for (int lane = 0; lane < packet_size; ++lane)
            blocked[start + lane] |= packet.tfar[lane] < 0 ? valid[lane] : 0;
    }
}

} // namespace tessera
