#pragma once

#include "render/load/load_context.h"
#include "render/load/properties.h"
#include "render/mesh/meshes.h"
#include "render/mesh/obj_scan.h"
#include "render/surface/mesh.h"

#include <cstddef>
#include <map>
#include <string>
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

/// Reads the MTL libraries that an OBJ file names, and adds the materials with faces to the scene. Kd, Ks, Ns, Ni,
/// d, map_Kd and map_d are used: as `phong`, or as `diffuse` without a specular part, both two-sided, as mirrors
/// (illum 5 and 8) or as glass (illum 4, 6, 7 and 9). Everything else and a missing library have a note; a library
/// that cannot be read has an error note. Returns indices into scene.materials by name.
std::map<std::string, int> read_mtl_libraries(LoadContext& context, const ObjScan& scan,
                                              const LoadContext::File& obj);

} // namespace tessera
