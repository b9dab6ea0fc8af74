#pragma once

#include "render/surface/mesh.h"

#include <cmath>
#include <cstdlib>

namespace tessera {

inline void require(bool holds) {
    if (!holds)
        std::abort();
}

/// What a mesh promises to the rest of the program, whatever file it came from.
inline void require_sound(const Mesh& mesh) {
    for (const auto& triangle : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            require(triangle[i] < mesh.positions.size());
    for (const auto& p : mesh.positions)
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    require(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
    require(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size());
    for (const MeshAttribute& attribute : mesh.attributes)
        require(attribute.values.size() ==
                (attribute.is_of_faces() ? mesh.triangles.size() : mesh.positions.size()));
}

/// Fails for a mesh that does not hold together, or has normals that cannot be shaded.
inline void require_placed(const Mesh& mesh) {
    require_sound(mesh);
    for (const auto& n : mesh.normals)
        require(std::abs(n.x * n.x + n.y * n.y + n.z * n.z - 1) < 0.01f);
}

} // namespace tessera
