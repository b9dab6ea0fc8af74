#include "render/trace/intersector.h"

#include "render/trace/embree_scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace tessera {

namespace {

constexpr int packet_size = 8;

/// Limit on coordinates of rays: Embree fails far below the largest float.
constexpr float farthest = 1e18f;

bool is_sound(glm::vec3 v) {
    // All comparisons with NaN are false.
    return (std::abs(v.x) < farthest) & (std::abs(v.y) < farthest) & (std::abs(v.z) < farthest);
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

/// Returns a packet with the fields that are equal for all segments.
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

/// Puts segment m into a lane of the packet. Returns false if the segment is not finite.
bool set_ray(RTCRay8& packet, int lane, const SegmentLanes& s, int m) {
    packet.org_x[lane] = s.from.x[m];
    packet.org_y[lane] = s.from.y[m];
    packet.org_z[lane] = s.from.z[m];
    packet.dir_x[lane] = s.to.x[m] - s.from.x[m];
    packet.dir_y[lane] = s.to.y[m] - s.from.y[m];
    packet.dir_z[lane] = s.to.z[m] - s.from.z[m];
    packet.tfar[lane] = 1; // Embree sets it to -infinity if the segment is occluded
    return is_sound(s.from[m]) & is_sound(s.to[m]);
}

// Embree 3 and 4 pass the options of a query in different ways.
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

} // namespace

Intersector::Intersector() = default;
Intersector::~Intersector() = default;
Intersector::Intersector(Intersector&&) noexcept = default;
Intersector& Intersector::operator=(Intersector&&) noexcept = default;

bool Intersector::closest(const Ray& ray, Hit& hit) const {
    if (!is_sound(ray.origin) || !is_sound(ray.direction))
        return false;
    RTCRayHit query;
    query.ray = make_ray(ray.origin, ray.direction, std::numeric_limits<float>::infinity());
    if (impl_->has_instances())
        query.ray.id = ray_number(ray.origin, ray.direction);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(impl_->scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    hit.shape = query.hit.geomID;
    hit.triangle = query.hit.primID;
    hit.barycentric = {query.hit.u, query.hit.v};
    hit.distance = query.ray.tfar;
    hit.placement = nullptr;
    if (query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID) {
        const std::size_t instance = query.hit.instID[0] - impl_->first_instance;
        hit.shape += impl_->first_shape[instance];
        hit.placement = &impl_->placements[instance];
    }
    const glm::vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    if (const Quadric* quadric = impl_->quadric_at(hit.shape)) [[unlikely]] {
        hit.local = normal; // see attach()
        hit.geometric_normal = quadric->normal(hit.local);
    } else {
        hit.geometric_normal = unit(normal);
    }
    if (hit.placement)
        hit.geometric_normal = unit(hit.placement->of_normals * hit.geometric_normal);
    return true;
}

bool Intersector::occluded(const Segment& segment) const {
    if (!is_sound(segment.from) || !is_sound(segment.to))
        return true;
    RTCRay ray = make_ray(segment.from, segment.to - segment.from, 1);
    if (impl_->has_instances())
        ray.id = ray_number(segment.from, segment.to - segment.from);
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
            if (impl_->has_instances())
                packet.id[lane] = ray_number(segments.from[m], segments.to[m] - segments.from[m]);
        }
        if (!any)
            continue;
        test_occluded(impl_->scene, valid, packet);
        for (int lane = 0; lane < packet_size; ++lane)
            blocked[start + lane] |= packet.tfar[lane] < 0 ? valid[lane] : 0;
    }
}

} // namespace tessera
