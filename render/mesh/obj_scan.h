#pragma once

#include <cstddef>
#include <functional>
#include <istream>
#include <map>
#include <string>
#include <vector>

namespace tessera {

/// Counts and names in an OBJ file, found before tinyobjloader reads it.
struct ObjScan {
    std::size_t positions = 0, normals = 0, uvs = 0, colors = 0; ///< colors: positions with a colour
    std::size_t triangles = 0;                                   ///< of all faces
    std::size_t polygons = 0;                                    ///< faces of more than three corners
    /// Indices of items with NaN or infinite numbers, which tinyobjloader would read as 0.
    std::vector<std::size_t> broken_positions, broken_normals, broken_uvs;
    std::vector<std::string> materials;                      ///< names with faces, in file order; "": no name
    std::vector<std::string> libraries;                      ///< each as it follows `mtllib`
    std::map<std::string, std::size_t, std::less<>> unknown; ///< lines by their keyword, up to 20 keywords
    bool has_continuation = false;                           ///< whether a line continues on the next one
};

/// Scans the stream up to the first continued line, and rewinds it. Throws std::runtime_error with the line for
/// numbers that are invalid.
ObjScan scan_obj(std::istream& stream);

/// Returns the text with each line that ends in a backslash joined to the next one. Empty lines keep the
/// numbering.
std::string join_lines(std::istream& stream);

} // namespace tessera
