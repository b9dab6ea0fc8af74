#include "render/surface/mesh.h"

#include <glm/geometric.hpp>

namespace tessera {

glm::vec3 front_normal(const Mesh& mesh, glm::uvec3 t) {
    // Double is needed: the square of a small or large triangle's area is beyond floats.
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

SurfacePoint surface_point(const Mesh& mesh, std::size_t triangle, glm::vec2 barycentric) {
    const glm::uvec3 t = mesh.triangles[triangle];
    const float first = 1 - barycentric.x - barycentric.y;
    SurfacePoint at{barycentric};
    if (!mesh.uvs.empty())
        at.uv = first * mesh.uvs[t.x] + barycentric.x * mesh.uvs[t.y] + barycentric.y * mesh.uvs[t.z];
    if (!mesh.colors.empty())
        at.vertex_color =
            first * mesh.colors[t.x] + barycentric.x * mesh.colors[t.y] + barycentric.y * mesh.colors[t.z];
    return at;
}

} // namespace tessera
