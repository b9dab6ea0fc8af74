#include "render/scene/mesh.h"

#include <glm/geometric.hpp>

namespace tessera {

glm::vec3 front_normal(const Mesh& mesh, glm::uvec3 t) {
    // In double: the square of a small or large triangle's area is beyond floats.
    const glm::dvec3 corner = mesh.positions[t.x];
    const glm::dvec3 cross =
        glm::cross(glm::dvec3(mesh.positions[t.y]) - corner, glm::dvec3(mesh.positions[t.z]) - corner);
    const double length = glm::length(cross);
    if (!(length > 0))
        return glm::vec3(0);
    const glm::vec3 n(cross / length);
    if (mesh.normals.empty())
        return n;
    const glm::vec3 sum = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    return glm::dot(sum, n) < 0 ? -n : n;
}

} // namespace tessera
