#pragma once

#include "render/scene/mesh.h"

#include <string>

#include <glm/mat4x4.hpp>

namespace tessera {

/// How a shape's mesh becomes the scene's.
struct MeshPlacement {
    glm::mat4 to_world{1.0f};
    bool face_normals = false; ///< drop the normals of the vertices, and compute none
    bool flip_normals = false; ///< turn the inside out
};

/// Moves a mesh of a file to its place. Normals move with the inverse transpose; where the file has none, or
/// unusable ones, they are computed. Triangles keep their order. Returns a note, or nothing; throws
/// std::runtime_error when a position is not finite.
std::string place_mesh(Mesh& mesh, const MeshPlacement& placement);

/// The same for a shape made of flat faces, whose order of corners follows to_world: what was outside stays
/// outside under a mirror image.
void place_flat_mesh(Mesh& mesh, const MeshPlacement& placement);

/// Smooth normals, the faces weighted by their angles [Thuermer and Wuethrich 1998]. A vertex without a face of
/// positive area gets +z.
void compute_normals(Mesh& mesh);

} // namespace tessera
