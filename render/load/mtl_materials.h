#pragma once

#include "render/load/load_context.h"
#include "render/mesh/obj_scan.h"

#include <map>
#include <string>

namespace tessera {

/// Reads the MTL libraries that an OBJ file names, and adds the materials with faces to the scene. Kd, Ks, Ns, Ni,
/// d, map_Kd and map_d are used: as `phong`, or as `diffuse` without a specular part, both two-sided, as mirrors
/// (illum 5 and 8) or as glass (illum 4, 6, 7 and 9). Everything else and a missing library have a note; a library
/// that cannot be read has an error note. Returns indices into scene.materials by name.
std::map<std::string, int> read_mtl_libraries(LoadContext& context, const ObjScan& scan,
                                              const LoadContext::File& obj);

} // namespace tessera
