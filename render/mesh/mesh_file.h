#pragma once

#include "render/surface/mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// Findings of the reader of a mesh or image file.
struct FileReport {
    std::vector<std::string> contents; ///< what is in the mesh: "4 positions", "normals"
    std::vector<std::string> ignored;  ///< what has no effect: "the element 'edge'"
    std::vector<std::string> notes;    ///< what was chosen or converted
    std::vector<std::string> errors;   ///< damage that was replaced or left out
};

/// Consecutive triangles that an OBJ file lists under the same object or group and material.
struct MeshPart {
    std::string name;     ///< of the object or group; empty: none
    std::string material; ///< named by `usemtl`; empty: none
    std::size_t first_triangle = 0, triangles = 0;
};

/// A mesh as it is in a file. Normals have any length, also 0, and may be NaN or infinite: place_mesh() replaces
/// them. All other numbers are finite and all indices valid.
struct MeshFile {
    Mesh mesh;
    FileReport report;
    std::vector<MeshPart> parts{}; ///< all triangles, in file order; empty: the format has no parts
    bool face_normals = false;     ///< whether the file requests face normals
};

/// A polygon as readers store it: a fan of `corners` - 2 triangles (c0, c1, c2), (c0, c2, c3), ...
struct PolygonFan {
    std::size_t first_triangle = 0;
    std::size_t corners = 0;
};

/// Replaces fans that do not cover their polygon, because a corner is reflex as seen from the first one, by ear
/// clipping [Meisters 1975]. A polygon keeps its number of triangles; a triangle may have no area. Returns how
/// many polygons stay fans, because their edges cross or they have more than 10,000 corners.
std::size_t cut_polygons(Mesh& mesh, std::span<const PolygonFan> polygons);

/// Gives each triangle corner its own texture coordinates (three per triangle). Vertices whose corners differ are
/// split. Throws OutOfMemory.
void set_corner_uvs(Mesh& mesh, std::span<const glm::vec2> corner_uvs);

/// Leaves out triangles with a position that is not finite, and replaces other numbers that are not finite by 0,
/// except normals. Returns a text for each kind of damage.
std::vector<std::string> repair_mesh(Mesh& mesh);

/// Returns a mesh of the triangles in those parts, with the vertices that they use.
Mesh mesh_of_parts(const Mesh& mesh, std::span<const MeshPart* const> parts);

/// Returns "1 face" or "3 faces".
std::string counted(std::size_t count, std::string_view noun);

/// Returns whether a word is how a program writes NaN or infinity: "nan", "-inf", "1.#IND".
bool is_non_finite_word(std::string_view word);

} // namespace tessera
