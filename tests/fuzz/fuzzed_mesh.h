#pragma once

#include "render/surface/mesh.h"

#include <cmath>
#include <cstdlib>

namespace tessera {

inline void require(bool holds) {
    if (!holds)
        std::abort();
}

/// Checks the invariants of a mesh that the rest of the program relies on. Aborts if one does not hold.
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

/// Checks the invariants of a placed mesh: as require_sound(), and unit normals.
inline void require_placed(const Mesh& mesh) {
    require_sound(mesh);
    for (const auto& n : mesh.normals)
        require(std::abs(n.x * n.x + n.y * n.y + n.z * n.z - 1) < 0.01f);
}

} // namespace tessera
