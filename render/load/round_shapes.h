#pragma once

#include "render/scene/mesh.h"

namespace tessera {

// Round shapes as triangles, with the exact normals and Mitsuba's uv at the vertices. Each has its shape's exact
// area (to float precision): the vertices stand a little outside of it, the middles of the triangles a little
// inside.

/// Radius 1 about the origin, seen from outside; u = phi / 2 pi about +z, v = theta / pi from +z. No point of it
/// is further than 2e-4 from the sphere.
Mesh make_sphere();

/// Radius 1 about the origin in the plane z = 0, its front toward +z, without normals; u = radius, v = phi / 2 pi.
Mesh make_disk();

/// The side of a cylinder of radius 1 about the z axis from z = 0 to 1, seen from outside and open at both ends;
/// u = phi / 2 pi, v = z.
Mesh make_cylinder();

} // namespace tessera
