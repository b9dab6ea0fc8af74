#pragma once

#include "render/scene/mesh.h"

#include <filesystem>
#include <istream>

namespace tessera {

/// One mesh of a file in Mitsuba's format "serialized".
struct SerializedMesh {
    Mesh mesh;                 ///< normals of any length; colours are taken as linear
    bool face_normals = false; ///< the file asks for the normals of faces
};

/// Versions 3 and 4 (the latter with names), single or double precision. `index` counts the file's meshes from 0.
/// Memory grows with what the file holds, not with what it promises. Throws std::runtime_error.
SerializedMesh read_serialized(const std::filesystem::path& file, int index);
SerializedMesh parse_serialized(std::istream& stream, int index);

} // namespace tessera
