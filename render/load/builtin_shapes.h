#pragma once

#include "render/scene/mesh.h"

namespace tessera {

/// [-1, 1]^2 in the plane z = 0, its front toward +z, with uv from 0 to 1.
Mesh make_rectangle();

/// [-1, 1]^3, seen from outside, with uv from 0 to 1 on every face as Mitsuba lays it.
Mesh make_cube();

} // namespace tessera
