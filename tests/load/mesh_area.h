#pragma once

#include "render/surface/mesh.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera::test {

/// Returns the sum of the areas of a mesh's triangles.
inline double area_of(const Mesh& mesh) {
    double area = 0;
    for (const glm::uvec3 t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        area += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return area;
}

} // namespace tessera::test
