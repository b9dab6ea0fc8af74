#pragma once

#include "render/load/load_context.h"
#include "render/load/properties.h"
#include "render/mesh/meshes.h"
#include "render/surface/mesh.h"

#include <cstddef>
#include <vector>

namespace tessera {

/// Reads the parameters of all shapes: `to_world` and `flip_normals`.
MeshPlacement placement_parameters(Properties& p);

// Readers of shapes in files. A job fills shapes[index].mesh. A file that is missing or cannot be read leaves the
// shape empty, with an error note. They throw LoadError for an invalid parameter.
void read_ply_shape(LoadContext& context, Properties& p, std::vector<Shape>& shapes, std::size_t index);
void read_serialized_shape(LoadContext& context, Properties& p, std::vector<Shape>& shapes, std::size_t index);

/// Also reads the shape's BSDFs. Without `name` the first is for all parts; one with a `name` is for parts of the
/// material that `usemtl` names so. Other parts have the material of that name in the file's MTL libraries, or the
/// default. Each further material adds a copy of shapes[index] for its parts.
void read_obj_shape(LoadContext& context, Properties& p, std::vector<Shape>& shapes, std::size_t index);

} // namespace tessera
