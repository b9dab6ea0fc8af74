#pragma once

#include "render/scene/mesh.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace tessera {

/// Wavefront OBJ: positions, texture coordinates, normals and faces; polygons become fans, groups and materials
/// are passed over. Normals may have any length, 0 included. Throws std::runtime_error that says what is wrong and
/// where.
Mesh read_obj(const std::filesystem::path& file);
Mesh parse_obj(std::string text);

/// Stanford PLY, text or binary of either byte order: vertices with x y z, nx ny nz, u v (or s t, or texture_u
/// texture_v) and faces; polygons become fans, other elements and properties are passed over. Errors as above.
Mesh read_ply(const std::filesystem::path& file);
Mesh parse_ply(std::string_view bytes);

/// All of a file's bytes; throws std::runtime_error.
std::string read_bytes(const std::filesystem::path& file);

} // namespace tessera
