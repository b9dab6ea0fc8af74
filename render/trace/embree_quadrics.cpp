// Quadrics as Embree's user geometry.
#include "render/shapes/quadric.h"
#include "render/surface/texture.h"
#include "render/trace/embree_scene.h"

#include <array>
#include <limits>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

#if TESSERA_EMBREE_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

/// Returns the first hit of ray i that its interval contains and the opacity does not reject; null: none.
/// @param hits  receives all points on the line
const Quadric::Hit* first_hit(const QuadricGeometry& geometry, const QueryContext& context, unsigned shape,
                              RTCRayN* rays, unsigned count, unsigned i, std::array<Quadric::Hit, 2>& hits) {
    const glm::vec3 origin(RTCRayN_org_x(rays, count, i), RTCRayN_org_y(rays, count, i),
                           RTCRayN_org_z(rays, count, i));
    const glm::vec3 direction(RTCRayN_dir_x(rays, count, i), RTCRayN_dir_y(rays, count, i),
                              RTCRayN_dir_z(rays, count, i));
    const float nearest = RTCRayN_tnear(rays, count, i), farthest = RTCRayN_tfar(rays, count, i);
    const int found = geometry.quadric->intersect(origin, direction, hits);
    for (int k = 0; k < found; ++k) {
        const auto distance = static_cast<float>(hits[k].distance);
        if (!(distance > nearest && distance < farthest))
            continue;
        if (geometry.opacity) {
            const glm::vec2 uv = geometry.quadric->uv(hits[k].local);
            const float opacity = luminance(geometry.opacity->evaluate(uv));
            // The two hits of a ray have different numbers.
            if (chance_of_hit(rays, count, i, context.instID[0], shape, static_cast<unsigned>(k), uv) >= opacity)
                continue;
        }
        return &hits[k];
    }
    return nullptr;
}

void bound(const RTCBoundsFunctionArguments* arguments) {
    const Quadric::Bounds box = static_cast<const QuadricGeometry*>(arguments->geometryUserPtr)->quadric->bounds();
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = box.low.x;
    bounds.lower_y = box.low.y;
    bounds.lower_z = box.low.z;
    bounds.upper_x = box.high.x;
    bounds.upper_y = box.high.y;
    bounds.upper_z = box.high.z;
}

void intersect(const RTCIntersectFunctionNArguments* a) {
    const auto& geometry = *static_cast<const QuadricGeometry*>(a->geometryUserPtr);
    RTCRayN* rays = RTCRayHitN_RayN(a->rayhit, a->N);
    RTCHitN* hit = RTCRayHitN_HitN(a->rayhit, a->N);
    std::array<Quadric::Hit, 2> hits;
    for (unsigned i = 0; i < a->N; ++i) {
        const Quadric::Hit* found =
            a->valid[i] ? first_hit(geometry, *a->context, a->geomID, rays, a->N, i, hits) : nullptr;
        if (!found)
            continue;
        RTCRayN_tfar(rays, a->N, i) = static_cast<float>(found->distance);
        RTCHitN_Ng_x(hit, a->N, i) = found->local.x;
        RTCHitN_Ng_y(hit, a->N, i) = found->local.y;
        RTCHitN_Ng_z(hit, a->N, i) = found->local.z;
        RTCHitN_u(hit, a->N, i) = RTCHitN_v(hit, a->N, i) = 0;
        RTCHitN_primID(hit, a->N, i) = a->primID;
        RTCHitN_geomID(hit, a->N, i) = a->geomID;
        RTCHitN_instID(hit, a->N, i, 0) = a->context->instID[0];
    }
}

void test_occluded(const RTCOccludedFunctionNArguments* a) {
    const auto& geometry = *static_cast<const QuadricGeometry*>(a->geometryUserPtr);
    std::array<Quadric::Hit, 2> hits;
    for (unsigned i = 0; i < a->N; ++i)
        if (a->valid[i] && first_hit(geometry, *a->context, a->geomID, a->ray, a->N, i, hits))
            RTCRayN_tfar(a->ray, a->N, i) = -std::numeric_limits<float>::infinity();
}

} // namespace

void attach(RTCDevice device, RTCScene scene, QuadricGeometry& quadric, unsigned id) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, 1);
    rtcSetGeometryUserData(geometry, &quadric);
    rtcSetGeometryBoundsFunction(geometry, bound, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcSetGeometryOccludedFunction(geometry, test_occluded);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
}

} // namespace tessera
