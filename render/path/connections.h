#pragma once

#include "render/path/offset_vertices.h"
#include "render/path/tracer.h"
#include "render/trace/pixel_lanes.h"

namespace tessera {

/// How the vertices of offset paths see one point that they are joined to, a lane a pixel.
struct ConnectionLanes {
    LaneMask valid;       ///< asked for, and the point is to be seen from the right side
    Vec3Lanes direction;  ///< unit, world, toward the point
    FloatLanes geometry;  ///< |cos| at the point over the squared distance: solid angle over area
    FloatLanes distance2; ///< squared, to the point; not for directions
};

/// Joins vertices to a point on a surface.
/// @param one_sided  only from the side of `normal`
void connect_to_point(const OffsetVertices& y, const LaneMask& asked, glm::vec3 point, glm::vec3 normal,
                      bool one_sided, ConnectionLanes& seen);

/// What arrives at the vertices from a point on a light, a lane a pixel.
struct LightLanes {
    Vec3Lanes radiance;
    FloatLanes pdf_w; ///< of emitter sampling there (LightRay::pdf_w)
};

/// Joins vertices to a point on a light, or at infinity to a direction.
void connect_to_light(const OffsetVertices& y, const LaneMask& asked, const LightPoint& light,
                      ConnectionLanes& seen, LightLanes& arriving);

/// The stretches from vertices to a point on a surface, ...
void edges_to_point(const Tracer& tracer, const OffsetVertices& y, const Vec3Lanes& direction, glm::vec3 point,
                    glm::vec3 normal, SegmentLanes& segments);
/// ... and to a light, which may be at infinity.
void edges_to_light(const Tracer& tracer, const OffsetVertices& y, const Vec3Lanes& direction,
                    const LightPoint& light, SegmentLanes& segments);

} // namespace tessera
