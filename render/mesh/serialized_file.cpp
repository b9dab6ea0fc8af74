#include "render/io/available_memory.h"
#include "render/io/byte_stream.h"
#include "render/io/files.h"
#include "render/mesh/meshes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include <glm/vec3.hpp>

namespace tessera {

// The format is documented with Mitsuba's shape plugin "serialized". A mesh is an uncompressed header and one
// zlib stream. A file holds several meshes in sequence, then a table of their offsets.

namespace {

static_assert(std::endian::native == std::endian::little, "serialized files are little endian");

constexpr std::uint16_t file_signature = 0x041C;
constexpr std::uint64_t max_inflation = 1032; // bytes per compressed byte [RFC 1951: 258 bytes in 2 bits]

enum Flag : std::uint32_t {
    has_normals = 0x0001,
    has_uvs = 0x0002,
    has_colors = 0x0008,
    has_face_normals = 0x0010,
    has_doubles = 0x2000,
};

template <class T>
T read_raw(std::istream& stream) {
    T value{};
    if (!stream.read(reinterpret_cast<char*>(&value), sizeof(T)))
        throw std::runtime_error("the file ends too early");
    return value;
}

std::uint16_t read_version(std::istream& stream) {
    if (read_raw<std::uint16_t>(stream) != file_signature)
        throw std::runtime_error("this is not a file of serialized meshes");
    const auto version = read_raw<std::uint16_t>(stream);
    if (version != 3 && version != 4)
        throw std::runtime_error("version " + std::to_string(version) +
                                 " of the format is not known (3 and 4 are)");
    return version;
}

/// Seeks to the first compressed byte of the mesh. Returns the format version.
std::uint16_t seek_mesh(std::istream& stream, std::uint64_t size, int index) {
    stream.seekg(0);
    const std::uint16_t version = read_version(stream);
    if (index == 0)
        return version;
    if (size < 8)
        throw std::runtime_error("the file ends too early");
    stream.seekg(static_cast<std::streamoff>(size - 4));
    const auto count = read_raw<std::uint32_t>(stream);
    const auto wanted = static_cast<std::uint64_t>(index);
    const std::uint64_t entry = version == 4 ? 8 : 4; // bytes
    if (count * entry > size - 8)
        throw std::runtime_error("the table at the end of the file is broken");
    if (wanted >= count)
        throw std::runtime_error("there is no mesh " + std::to_string(index) + ", only " + std::to_string(count));
    stream.seekg(static_cast<std::streamoff>(size - 4 - entry * (count - wanted)));
    const std::uint64_t begin =
        version == 4 ? read_raw<std::uint64_t>(stream) : std::uint64_t{read_raw<std::uint32_t>(stream)};
    if (begin > size - 8)
        throw std::runtime_error("the table at the end of the file is broken");
    stream.seekg(static_cast<std::streamoff>(begin));
    return read_version(stream);
}

/// Reads rows of numbers in blocks and converts them to float. Numbers beyond its range become infinite.
class Rows {
public:
    Rows(ZlibReader& zlib, bool doubles) : zlib_(zlib), doubles_(doubles) {}

    template <class Vector>
    void read(std::vector<Vector>& rows, std::uint64_t count) {
        if (doubles_)
            read_as<double>(rows, count);
        else
            read_as<float>(rows, count);
    }

private:
    template <class Number, class Vector>
    void read_as(std::vector<Vector>& rows, std::uint64_t count) {
        constexpr std::size_t width = sizeof(Vector) / sizeof(float);
        constexpr std::size_t block = 1024; // rows
        std::array<Number, width * block> numbers;
        rows.reserve(count);
        while (rows.size() < count) {
            const auto chunk = static_cast<std::size_t>(std::min<std::uint64_t>(block, count - rows.size()));
            zlib_.read(numbers.data(), chunk * width * sizeof(Number));
            for (std::size_t i = 0; i < chunk; ++i) {
                Vector row;
                for (std::size_t j = 0; j < width; ++j)
                    row[static_cast<int>(j)] = static_cast<float>(numbers[i * width + j]);
                rows.push_back(row);
            }
        }
    }

    ZlibReader& zlib_;
    bool doubles_;
};

void read_triangles(ZlibReader& zlib, Mesh& mesh, std::uint64_t count) {
    constexpr std::size_t block = 1024;
    std::array<glm::uvec3, block> triangles;
    mesh.triangles.reserve(count);
    while (mesh.triangles.size() < count) {
        const auto chunk = static_cast<std::size_t>(std::min<std::uint64_t>(block, count - mesh.triangles.size()));
        zlib.read(triangles.data(), chunk * sizeof(glm::uvec3));
        for (std::size_t i = 0; i < chunk; ++i) {
            for (int j = 0; j < 3; ++j)
                if (triangles[i][j] >= mesh.positions.size())
                    throw std::runtime_error("triangle " + std::to_string(mesh.triangles.size()) +
                                             " refers to vertex " + std::to_string(triangles[i][j]) +
                                             ", but there are " + std::to_string(mesh.positions.size()));
            mesh.triangles.push_back(triangles[i]);
        }
    }
}

/// Throws std::runtime_error if a file of `size` bytes cannot hold the declared counts. Call it before
/// allocating.
void check_counts(std::uint64_t vertices, std::uint64_t triangles, std::uint64_t vertex_bytes,
                  std::uint64_t size) {
    const std::uint64_t largest = size * max_inflation;
    if (vertices > largest / vertex_bytes || triangles > largest / sizeof(glm::uvec3))
        throw std::runtime_error("the file declares " + std::to_string(vertices) + " vertices and " +
                                 std::to_string(triangles) + " triangles, but is too short for them");
    if (vertices >= std::numeric_limits<std::uint32_t>::max())
        throw std::runtime_error("there are too many vertices");
}

void skip_name(ZlibReader& zlib) {
    while (zlib.read_value<char>() != '\0') {
    }
}

} // namespace

MeshFile parse_serialized(std::istream& stream, int index) {
    stream.seekg(0, std::ios::end);
    const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(stream.tellg(), 0));
    const std::uint16_t version = seek_mesh(stream, size, index);
    ZlibReader zlib(stream);
    const auto flags = zlib.read_value<std::uint32_t>();
    if (version == 4)
        skip_name(zlib);
    const auto vertices = zlib.read_value<std::uint64_t>();
    const auto triangles = zlib.read_value<std::uint64_t>();
    const std::uint64_t numbers =
        3u + (flags & has_normals ? 3u : 0u) + (flags & has_uvs ? 2u : 0u) + (flags & has_colors ? 3u : 0u);
    check_counts(vertices, triangles, numbers * (flags & has_doubles ? 8 : 4), size);
    const std::uint64_t computed = flags & has_normals ? 0 : 3; // normals
    require_memory(vertices * (numbers + computed) * sizeof(float) + triangles * sizeof(glm::uvec3),
                   "its " + std::to_string(vertices) + " vertices and " + std::to_string(triangles) +
                       " triangles");

    MeshFile result;
    Rows rows(zlib, flags & has_doubles);
    rows.read(result.mesh.positions, vertices);
    if (flags & has_normals)
        rows.read(result.mesh.normals, vertices);
    if (flags & has_uvs)
        rows.read(result.mesh.uvs, vertices);
    if (flags & has_colors)
        rows.read(result.mesh.attributes.emplace_back(MeshAttribute{std::string(vertex_color), {}}).values,
                  vertices);
    read_triangles(zlib, result.mesh, triangles);
    result.face_normals = flags & has_face_normals;
    result.report.contents = {counted(vertices, "position"), counted(triangles, "triangle")};
    for (const auto& [flag, name] :
         {std::pair(has_normals, "normals"), std::pair(has_uvs, "texture coordinates"),
          std::pair(has_colors, "colours"), std::pair(has_face_normals, "face normals")})
        if (flags & flag)
            result.report.contents.emplace_back(name);
    result.report.errors = repair_mesh(result.mesh);
    return result;
}

MeshFile read_serialized(const std::filesystem::path& file, int index) {
    std::ifstream stream = open_file(file);
    return parse_serialized(stream, index);
}

} // namespace tessera
