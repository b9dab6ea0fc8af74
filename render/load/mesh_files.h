#pragma once

#include "render/scene/mesh.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

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
/// texture_v), red green blue (or r g b, or diffuse_red ...) and faces; polygons become fans, other elements and
/// properties are passed over. Errors as above.
Mesh read_ply(const std::filesystem::path& file, PlyColors colors = {});
Mesh parse_ply(std::string_view bytes, PlyColors colors = {});

/// A file to be read from its beginning; throws std::runtime_error.
std::ifstream open_file(const std::filesystem::path& file);

/// All of a file's bytes; throws std::runtime_error.
std::string read_bytes(const std::filesystem::path& file);

} // namespace tessera
