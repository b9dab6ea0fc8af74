#pragma once

#include "recon/image.h"

#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Where on a surface a texture is looked up.
struct SurfacePoint {
    glm::vec2 uv{0};
    Rgb vertex_color{1}; ///< of a mesh that has such, interpolated
};

/// Triangles in world space.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;    ///< unit, one a position; empty: every triangle has its own normal
    std::vector<glm::vec2> uvs;        ///< one a position; empty: barycentric coordinates serve as uv
    std::vector<glm::vec3> colors;     ///< linear RGB, one a position; empty: none
    std::vector<glm::uvec3> triangles; ///< indices of positions, counter-clockwise seen from outside
};

/// The unit normal of a triangle, on the side to which the corners' normals point where there are any, else the
/// one from which the corners run counter-clockwise. 0: the triangle has no area.
glm::vec3 front_normal(const Mesh& mesh, glm::uvec3 triangle);

/// Where textures are looked up, at barycentric coordinates (weights of the second and third corner).
SurfacePoint surface_point(const Mesh& mesh, std::size_t triangle, glm::vec2 barycentric);

/// A mesh with what it is made of and, perhaps, the light it gives off.
struct Shape {
    std::string name; ///< the id in the file, or the plugin's name
    Mesh mesh;
    int material = 0;    ///< index into SceneDescription::materials
    int area_light = -1; ///< index into SceneDescription::area_lights, -1: gives off no light
};

inline glm::vec3 front_normal(const Mesh& mesh, glm::uvec3 t) {
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

inline SurfacePoint surface_point(const Mesh& mesh, std::size_t triangle, glm::vec2 barycentric) {
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
