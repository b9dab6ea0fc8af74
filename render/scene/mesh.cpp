#include "render/scene/mesh.h"

#include <glm/geometric.hpp>

namespace tessera {

glm::vec3 front_normal(const Mesh& mesh, glm::uvec3 t) {
    const glm::vec3 corner = mesh.positions[t.x];
    const glm::vec3 n = glm::cross(mesh.positions[t.y] - corner, mesh.positions[t.z] - corner);
    const float length = glm::length(n);
    if (!(length > 0))
        return glm::vec3(0);
    if (mesh.normals.empty())
        return n / length;
    const glm::vec3 sum = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    return glm::dot(sum, n) < 0 ? -n / length : n / length;
}

} // namespace tessera
