#pragma once

#include "recon/image.h"
#include "render/shapes/quadric.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

struct Mesh;

/// The point of a surface at which textures are looked up.
struct SurfacePoint {
    glm::vec2 uv{0};
    const Mesh* mesh = nullptr; ///< mesh with attributes; null: none, or unused

    /// Sides of a parallelogram around uv over which Texture::filtered() averages; 0: a point.
    struct Footprint {
        glm::vec2 along{0}, across{0};
    };
    struct OnMesh {
        std::uint32_t triangle;
        glm::vec2 barycentric; ///< weights of the second and third vertex
    };
    /// A union, because some BSDFs contain a SurfacePoint and a Bsdf is small. With a mesh on_mesh is active,
    /// else footprint.
    union {
        Footprint footprint{};
        OnMesh on_mesh;
    };

    SurfacePoint() = default;
    SurfacePoint(glm::vec2 uv_) : uv(uv_) {}

    /// Returns an attribute of the mesh, interpolated over the triangle; white if there is none of that name.
    Rgb attribute(std::string_view name) const;
};

/// Name of the attribute that holds vertex colours.
inline constexpr std::string_view vertex_color = "vertex_color";

/// Values at the vertices or faces of a mesh that textures look up.
struct MeshAttribute {
    std::string name; ///< starts with "vertex_" or "face_", which says what it belongs to, as in Mitsuba 3
    std::vector<glm::vec3> values; ///< one per position or per triangle; linear colours; single numbers are grey

    bool is_of_faces() const { return name.starts_with("face_"); }
};

/// Triangles in world space, or in the local space of a ShapeGroup.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;        ///< unit, one per position; empty: flat shading
    std::vector<glm::vec2> uvs;            ///< one per position; empty: barycentric coordinates serve as uv
    std::vector<MeshAttribute> attributes; ///< with unique names
    std::vector<glm::uvec3> triangles;     ///< indices of positions, counter-clockwise as seen from outside

    /// Returns the attribute of this name; null if there is none.
    const MeshAttribute* attribute(std::string_view name) const {
        const auto found = std::ranges::find(attributes, name, &MeshAttribute::name);
        return found == attributes.end() ? nullptr : &*found;
    }
};

/// Returns the unit normal of a triangle; 0 if it has no area. Its side is that of the vertex normals if there
/// are any, else the side from which the vertices run counter-clockwise.
glm::vec3 front_normal(const Mesh& mesh, glm::uvec3 triangle);

/// Returns the surface point at barycentric coordinates (weights of the second and third vertex).
SurfacePoint surface_point(const Mesh& mesh, std::size_t triangle, glm::vec2 barycentric);

/// A mesh or a quadric with its material and, if it emits light, its area light.
struct Shape {
    std::string name;    ///< id in the file, or name of the plugin
    Mesh mesh;           ///< empty if there is a quadric
    int material = 0;    ///< index into SceneDescription::materials
    int area_light = -1; ///< index into SceneDescription::area_lights; -1: no emission
    std::optional<Quadric> quadric{};
};

/// Shapes in local space, stored once for all instances.
struct ShapeGroup {
    std::string name;
    std::vector<Shape> shapes; ///< none emits light
};

/// A placement of a group in the scene. Instances are not nested.
struct Instance {
    int group = 0;            ///< index into SceneDescription::groups
    glm::mat4 to_world{1.0f}; ///< affine and invertible
};

/// Returns the matrix that transforms normals: the inverse transpose times the absolute determinant, which also
/// exists for singular transforms.
inline glm::mat3 normal_matrix(const glm::mat3& m) {
    const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::determinant(m) < 0 ? -cofactors : cofactors;
}

inline glm::vec3 front_normal(const Mesh& mesh, glm::uvec3 t) {
    // In double, because the squared area of a small or large triangle exceeds the range of float.
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
    SurfacePoint at(barycentric);
    if (!mesh.uvs.empty())
        at.uv = first * mesh.uvs[t.x] + barycentric.x * mesh.uvs[t.y] + barycentric.y * mesh.uvs[t.z];
    if (!mesh.attributes.empty()) {
        at.mesh = &mesh;
        at.on_mesh = {static_cast<std::uint32_t>(triangle), barycentric};
    }
    return at;
}

} // namespace tessera
