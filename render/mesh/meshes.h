// Meshes from files, their way into a scene, and shapes made of triangles.
#pragma once

#include "render/surface/mesh.h"

#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

#include <glm/mat4x4.hpp>

namespace tessera {

/// Wavefront OBJ: positions, texture coordinates, normals and faces; polygons become fans, groups and materials
/// are passed over. Normals may have any length, 0 included. Throws std::runtime_error that says what is wrong and
/// where.
Mesh read_obj(const std::filesystem::path& file);
Mesh parse_obj(const std::string& text);

/// How a PLY file's colours are coded: sRGB, or linear.
struct PlyColors {
    bool srgb_bytes = true; ///< integers of any size
    bool srgb_floats = false;
};

/// Stanford PLY, text or binary of either byte order: vertices with x y z, nx ny nz, u v (or s t, or texture_u
/// texture_v), faces, and attributes of both such as red green blue (see PlyLayout); polygons become fans,
/// other elements and properties are passed over. Throws as read_obj does.
Mesh read_ply(const std::filesystem::path& file, PlyColors colors = {});
Mesh parse_ply(std::string_view bytes, PlyColors colors = {});

/// One mesh of a file in Mitsuba's format "serialized".
struct SerializedMesh {
    Mesh mesh;                 ///< normals of any length; colours are taken as linear
    bool face_normals = false; ///< the file asks for the normals of faces
};

/// Versions 3 and 4 (the latter with names), single or double precision. `index` counts the file's meshes from 0.
/// Memory grows with what the file holds, not with what it promises. Throws std::runtime_error.
SerializedMesh read_serialized(const std::filesystem::path& file, int index);
SerializedMesh parse_serialized(std::istream& stream, int index);

/// How a shape's mesh becomes the scene's.
struct MeshPlacement {
    glm::mat4 to_world{1.0f};
    bool face_normals = false;               ///< drop the normals of the vertices, and compute none
    std::optional<float> max_smooth_angle{}; ///< smooth_normals() with this in place of the file's normals
    bool flip_normals = false;               ///< turn the inside out
};

/// Moves a mesh of a file to its place. Normals move with the inverse transpose; where the file has none, or
/// unusable ones, they are computed. Triangles keep their order. Returns a note, or nothing; throws
/// std::runtime_error when a position is not finite.
std::string place_mesh(Mesh& mesh, const MeshPlacement& placement);

/// Moves a shape made of flat faces, whose order of corners follows to_world: what was outside stays outside under
/// a mirror image.
void place_flat_mesh(Mesh& mesh, const MeshPlacement& placement);

/// Smooth normals, the faces weighted by their angles [Thuermer and Wuethrich 1998]. A vertex without a face of
/// positive area gets +z.
void compute_normals(Mesh& mesh);

/// Smooth normals as of compute_normals(), but for edges between faces whose normals are further apart than
/// `max_angle` (degrees): there vertices are split, so that each side has its own. Edges join vertices in one
/// place.
void smooth_normals(Mesh& mesh, float max_angle);

/// The square [-1, 1]^2 in the plane z = 0, its front toward +z, with uv from 0 to 1.
Mesh make_rectangle();

/// The cube [-1, 1]^3, seen from outside, with uv from 0 to 1 on every face as Mitsuba lays it.
Mesh make_cube();

// Round shapes as triangles, with the exact normals and Mitsuba's uv at the vertices. Each has its shape's exact
// area (to float precision): the vertices stand a little outside of it, the middles of the triangles a little
// inside.

/// A sphere of radius 1 about the origin, seen from outside; u = phi / 2 pi about +z, v = theta / pi from +z. No
/// point of it is further than 2e-4 from the exact one.
Mesh make_sphere();

/// A disk of radius 1 about the origin in the plane z = 0, its front toward +z, without normals; u = radius, v =
/// phi / 2 pi.
Mesh make_disk();

/// The side of a cylinder of radius 1 about the z axis from z = 0 to 1, seen from outside and open at both ends;
/// u = phi / 2 pi, v = z.
Mesh make_cylinder();

} // namespace tessera
