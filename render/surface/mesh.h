#pragma once

#include "recon/image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// Where on a surface a texture is looked up.
struct SurfacePoint {
    glm::vec2 uv{0};
    const Mesh* mesh = nullptr; ///< null: it has no attributes, or nothing looks them up

    /// The sides of a parallelogram about uv, over which Texture::filtered() takes the mean; 0: it is a point.
    struct Footprint {
        glm::vec2 along{0}, across{0};
    };
    struct OnMesh {
        std::uint32_t triangle;
        glm::vec2 barycentric; ///< weights of the second and third corner
    };
    /// Some BSDFs hold a point, and all have little room: with a mesh it is on_mesh, without one footprint.
    union {
        Footprint footprint{};
        OnMesh on_mesh;
    };

    SurfacePoint() = default;
    SurfacePoint(glm::vec2 uv_) : uv(uv_) {}

    /// An attribute of the mesh, interpolated between vertices; white where there is none of that name.
    Rgb attribute(std::string_view name) const;
};

/// The name of the attribute that vertices most often have.
inline constexpr std::string_view vertex_color = "vertex_color";

/// Numbers that a mesh has at its vertices or on its faces, for textures to look up.
struct MeshAttribute {
    std::string name; ///< as in Mitsuba 3: begins with "vertex_" or "face_", and that is what it is of
    std::vector<glm::vec3> values; ///< one a position, or one a triangle; colours are linear, one number is grey

    bool is_of_faces() const { return name.starts_with("face_"); }
};

/// Triangles in world space.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;        ///< unit, one a position; empty: every triangle has its own normal
    std::vector<glm::vec2> uvs;            ///< one a position; empty: barycentric coordinates serve as uv
    std::vector<MeshAttribute> attributes; ///< no two of the same name
    std::vector<glm::uvec3> triangles;     ///< indices of positions, counter-clockwise seen from outside

    /// Null: there is none of that name.
    const MeshAttribute* attribute(std::string_view name) const {
        const auto found = std::ranges::find(attributes, name, &MeshAttribute::name);
        return found == attributes.end() ? nullptr : &*found;
    }
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

/// Shapes in a space of their own, held once however often they stand in the scene.
struct ShapeGroup {
    std::string name;
    std::vector<Shape> shapes; ///< none gives off light
};

/// A group of shapes in the scene. Others than groups there are none in it.
struct Instance {
    int group = 0;            ///< index into SceneDescription::groups
    glm::mat4 to_world{1.0f}; ///< affine; has an inverse
};

/// What takes normals along with a transform of points: its inverse transpose times the determinant's size, which
/// is defined for flat transforms, too.
inline glm::mat3 normal_matrix(const glm::mat3& m) {
    const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::determinant(m) < 0 ? -cofactors : cofactors;
}

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
