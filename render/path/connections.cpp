#include "render/path/connections.h"

#include <cmath>

namespace tessera {

void connect_to_point(const OffsetVertices& y, const LaneMask& asked, glm::vec3 point, glm::vec3 normal,
                      bool one_sided, ConnectionLanes& seen) {
    for (int m = 0; m < padded(y.count()); ++m) {
        const float dx = point.x - y.position.x[m], dy = point.y - y.position.y[m], dz = point.z - y.position.z[m];
        const float distance2 = dx * dx + dy * dy + dz * dz;
        const float scale = 1 / std::sqrt(distance2);
        const float cosine = -(dx * normal.x + dy * normal.y + dz * normal.z) * scale;
        const float geometry = (one_sided ? cosine : std::abs(cosine)) / distance2;
        seen.direction.x[m] = dx * scale;
        seen.direction.y[m] = dy * scale;
        seen.direction.z[m] = dz * scale;
        seen.geometry[m] = geometry;
        seen.distance2[m] = distance2;
        seen.valid[m] = (geometry > 0) & (distance2 > 0) ? asked[m] : 0;
    }
}

void connect_to_light(const OffsetVertices& y, const LaneMask& asked, const LightPoint& light,
                      ConnectionLanes& seen, LightLanes& arriving) {
    if (light.kind == LightPoint::Kind::surface) {
        connect_to_point(y, asked, light.position, light.normal, true, seen);
        for (int m = 0; m < padded(y.count()); ++m) {
            arriving.pdf_w[m] = light.pdf / seen.geometry[m];
            arriving.radiance.x[m] = light.radiance.x;
            arriving.radiance.y[m] = light.radiance.y;
            arriving.radiance.z[m] = light.radiance.z;
        }
        return;
    }
    for (int m = 0; m < padded(y.count()); ++m)
        seen.valid[m] = 0;
    for (int m = 0; m < y.count(); ++m) {
        if (!asked[m])
            continue;
        const std::optional<LightRay> ray = light.seen_from(y.position[m]);
        if (!ray)
            continue;
        seen.valid[m] = -1;
        seen.direction.set(m, ray->direction);
        arriving.pdf_w[m] = ray->pdf_w;
        arriving.radiance.set(m, ray->radiance);
    }
}

void edges_to_point(const Tracer& tracer, const OffsetVertices& y, const Vec3Lanes& direction, glm::vec3 point,
                    glm::vec3 normal, SegmentLanes& segments) {
    const Intersector& intersector = tracer.scene.intersector();
    for (int m = 0; m < padded(y.count()); ++m) {
        const glm::vec3 d = direction[m];
        segments.from.set(m, intersector.off_surface(y.position[m], y.geometric_normal[m], d));
        segments.to.set(m, intersector.off_surface(point, normal, -d));
    }
}

void edges_to_light(const Tracer& tracer, const OffsetVertices& y, const Vec3Lanes& direction,
                    const LightPoint& light, SegmentLanes& segments) {
    if (!light.is_at_infinity())
        return edges_to_point(tracer, y, direction, light.position, light.normal, segments);
    for (int m = 0; m < y.count(); ++m) {
        if (!y.exists[m])
            continue;
        const Segment s = tracer.toward_light(y[m], light, direction[m]);
        segments.from.set(m, s.from);
        segments.to.set(m, s.to);
    }
}

} // namespace tessera
