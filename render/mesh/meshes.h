// Meshes: reading files, placement in a scene, and shapes with flat faces.
#pragma once

#include "render/mesh/mesh_file.h"
#include "render/surface/mesh.h"

#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

#include <glm/mat4x4.hpp>

namespace tessera {

/// Read Wavefront OBJ: positions, texture coordinates, normals, faces, and the names of objects, groups and
/// materials. Throw std::runtime_error with the reason and the place.
MeshFile read_obj(const std::filesystem::path& file);
MeshFile parse_obj(const std::string& text);

/// Encoding of a PLY file's colours: sRGB or linear.
struct PlyColors {
    bool srgb_bytes = true; ///< integers of any size
    bool srgb_floats = false;
};

/// Read Stanford PLY, text or binary of either byte order: vertices with x y z, nx ny nz, u v (or s t, or
/// texture_u texture_v), faces, also with texture coordinates of their corners (a list "texcoord"), triangle
/// strips, and attributes of vertices and faces, such as red green blue (see PlyLayout). Throw as read_obj() does.
MeshFile read_ply(const std::filesystem::path& file, PlyColors colors = {});
MeshFile parse_ply(std::string_view bytes, PlyColors colors = {});

/// Read one mesh of a file in Mitsuba's format "serialized", versions 3 or 4, in single or double precision.
/// Colours are read as linear. `index` counts the file's meshes from 0. Throw std::runtime_error, before
/// allocating if the file cannot hold the declared counts.
MeshFile read_serialized(const std::filesystem::path& file, int index);
MeshFile parse_serialized(std::istream& stream, int index);

/// Parameters for placing a shape's mesh in the scene.
struct MeshPlacement {
    glm::mat4 to_world{1.0f};
    bool face_normals = false;               ///< whether vertex normals are removed and not computed
    std::optional<float> max_smooth_angle{}; ///< degrees; smooth_normals() replaces the file's normals
    bool flip_normals = false;               ///< whether front and back are exchanged
};

/// Transforms a file's mesh to its place. Normals are transformed by the inverse transpose; missing or invalid
/// ones are computed. Triangles keep their order. Returns the text of an error, if there are invalid normals or no
/// triangles, or nothing. Throws std::runtime_error if the transform makes a position infinite.
std::string place_mesh(Mesh& mesh, const MeshPlacement& placement);

/// Transforms a mesh of flat faces, whose orientation follows the order of their corners. The outside stays the
/// outside under mirroring. Throws as place_mesh() does.
void place_flat_mesh(Mesh& mesh, const MeshPlacement& placement);

/// Computes smooth vertex normals, with faces weighted by their angle at the vertex [Thuermer and Wuethrich
/// 1998]. A vertex without a face of positive area gets +z.
void compute_normals(Mesh& mesh);

/// Computes smooth normals as compute_normals() does, except across edges whose face normals differ by more
/// than `max_angle` (degrees). There, vertices are split, so that each side has its own normal. Vertices at the
/// same position count as one.
void smooth_normals(Mesh& mesh, float max_angle);

/// Returns the square [-1, 1]^2 in the plane z = 0, with its front toward +z and uv from 0 to 1.
Mesh make_rectangle();

/// Returns the cube [-1, 1]^3, with its front outside, and uv from 0 to 1 on every face as in Mitsuba.
Mesh make_cube();

} // namespace tessera
