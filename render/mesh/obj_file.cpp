#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/mesh/meshes.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <tiny_obj_loader.h>

namespace tessera {

namespace {

constexpr std::string_view white_space = " \t\r";

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

/// Counts the words of a line, such as the corners of a face.
std::size_t count_words(std::string_view list) {
    std::size_t count = 0;
    bool after_space = true;
    for (const char c : list) {
        count += after_space && !is_space(c);
        after_space = is_space(c);
    }
    return count;
}

bool is_number_character(char c) {
    return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E';
}

/// Counts the numbers of a line; 0 if a character cannot be part of a number ("nan", "1,5").
std::size_t count_numbers(std::string_view list) {
    list = list.substr(0, list.find('#'));
    const bool is_plain =
        std::all_of(list.begin(), list.end(), [](char c) { return is_number_character(c) || is_space(c); });
    return is_plain ? count_words(list) : 0;
}

/// Counts of a file's items, for exact allocation.
struct ObjCounts {
    std::size_t positions = 0, normals = 0, uvs = 0, triangles = 0;
};

void require_numbers(std::string_view list, std::size_t needed, std::size_t line) {
    if (count_numbers(list) < needed)
        throw std::runtime_error("line " + std::to_string(line) + ": not a list of " + std::to_string(needed) +
                                 " numbers or more");
}

/// Counts items and checks numbers. tinyobjloader would read an invalid number as 0.
ObjCounts scan(std::istream& stream) {
    ObjCounts counts;
    std::string text;
    for (std::size_t line = 1; std::getline(stream, text); ++line) {
        std::string_view rest = text;
        rest.remove_prefix(std::min(rest.find_first_not_of(white_space), rest.size()));
        const std::string_view name = rest.substr(0, rest.find_first_of(white_space));
        rest.remove_prefix(name.size());
        if (name == "v" || name == "vn" || name == "vt")
            require_numbers(rest, name == "vt" ? 1 : 3, line);
        counts.positions += name == "v";
        counts.normals += name == "vn";
        counts.uvs += name == "vt";
        if (name == "f")
            counts.triangles += std::max<std::size_t>(count_words(rest), 2) - 2;
    }
    stream.clear();
    stream.seekg(0);
    return counts;
}

/// Collects what tinyobjloader reports, and makes one vertex of each combination of indices in use.
class ObjBuilder {
public:
    explicit ObjBuilder(const ObjCounts& counts) {
        // Memory peaks in finish(), which makes the mesh from the lists; normals are given or computed.
        const std::size_t vertex_bytes = 3 * sizeof(glm::vec3) + sizeof(ObjVertex) + sizeof(unsigned) +
                                         (counts.uvs > 0 ? sizeof(glm::vec2) : 0);
        require_memory(counts.positions * vertex_bytes + counts.normals * sizeof(glm::vec3) +
                           counts.uvs * sizeof(glm::vec2) + counts.triangles * sizeof(glm::uvec3),
                       "its " + std::to_string(counts.positions) + " vertices and " +
                           std::to_string(counts.triangles) + " triangles");
        positions_.reserve(counts.positions);
        first_vertex_.reserve(counts.positions);
        vertices_.reserve(counts.positions); // at least as many, if every position is used
        normals_.reserve(counts.normals);
        uvs_.reserve(counts.uvs);
        mesh_.triangles.reserve(counts.triangles);
    }

    void add_position(glm::vec3 p) {
        require_finite(p.x + p.y + p.z, "position", positions_.size());
        positions_.push_back(p);
        first_vertex_.push_back(none);
    }
    void add_normal(glm::vec3 n) { normals_.push_back(n); }
    void add_uv(glm::vec2 uv) {
        require_finite(uv.x + uv.y, "texture coordinate", uvs_.size());
        uvs_.push_back(uv);
    }

    void add_face(const tinyobj::index_t* corners, int count) {
        ++faces_;
        if (count < 3)
            return;
        const unsigned first = vertex(corners[0]);
        unsigned previous = vertex(corners[1]);
        for (int i = 2; i < count; ++i) {
            const unsigned current = vertex(corners[i]);
            mesh_.triangles.push_back({first, previous, current});
            previous = current;
        }
    }

    Mesh finish() {
        // Each list is released before the next array is allocated.
        release(first_vertex_);
        mesh_.positions.reserve(vertices_.size());
        for (const ObjVertex& v : vertices_)
            mesh_.positions.push_back(positions_[v.position]);
        release(positions_);
        if (!normals_.empty()) {
            mesh_.normals.reserve(vertices_.size());
            for (const ObjVertex& v : vertices_)
                mesh_.normals.push_back(v.normal == none ? glm::vec3(0) : normals_[v.normal]);
            release(normals_);
        }
        if (!uvs_.empty()) {
            mesh_.uvs.reserve(vertices_.size());
            for (const ObjVertex& v : vertices_)
                mesh_.uvs.push_back(v.uv == none ? glm::vec2(0) : uvs_[v.uv]);
        }
        mesh_.triangles.shrink_to_fit();
        return std::move(mesh_);
    }

private:
    static constexpr unsigned none = ~0u;

    struct ObjVertex {
        unsigned position, uv, normal;
        unsigned next; // index of another vertex at the same position, or none
    };

    template <class T>
    static void release(std::vector<T>& array) {
        array = std::vector<T>();
    }

    /// Throws std::runtime_error for numbers such as 1e99, which become infinite.
    static void require_finite(float sum, const char* name, std::size_t index) {
        if (!std::isfinite(sum))
            throw std::runtime_error(std::string(name) + " " + std::to_string(index + 1) + " is too large");
    }

    unsigned index(int from_file, std::size_t count, const char* name) const {
        // 1 is the first item, -1 the last item read so far.
        const long long i = from_file > 0 ? from_file - 1ll : static_cast<long long>(count) + from_file;
        if (from_file == 0 || i < 0 || i >= static_cast<long long>(count))
            throw std::runtime_error("face " + std::to_string(faces_) + " refers to " + name + " " +
                                     std::to_string(from_file) + ", but there are " + std::to_string(count) +
                                     " before it");
        return static_cast<unsigned>(i);
    }

    unsigned vertex(const tinyobj::index_t& corner) {
        const unsigned position = index(corner.vertex_index, positions_.size(), "position");
        const unsigned uv =
            corner.texcoord_index == 0 ? none : index(corner.texcoord_index, uvs_.size(), "texture coordinate");
        const unsigned normal =
            corner.normal_index == 0 ? none : index(corner.normal_index, normals_.size(), "normal");
        for (unsigned v = first_vertex_[position]; v != none; v = vertices_[v].next)
            if (vertices_[v].uv == uv && vertices_[v].normal == normal)
                return v;
        const auto added = static_cast<unsigned>(vertices_.size());
        vertices_.push_back({position, uv, normal, first_vertex_[position]});
        first_vertex_[position] = added;
        return added;
    }

    std::vector<glm::vec3> positions_;
    std::vector<glm::vec3> normals_;
    std::vector<glm::vec2> uvs_;
    std::vector<ObjVertex> vertices_;
    std::vector<unsigned> first_vertex_; // by position, an index of vertices_
    std::size_t faces_ = 0;
    Mesh mesh_;
};

tinyobj::callback_t callbacks() {
    tinyobj::callback_t result;
    result.vertex_cb = [](void* b, float x, float y, float z, float) {
        static_cast<ObjBuilder*>(b)->add_position({x, y, z});
    };
    result.normal_cb = [](void* b, float x, float y, float z) {
        static_cast<ObjBuilder*>(b)->add_normal({x, y, z});
    };
    result.texcoord_cb = [](void* b, float u, float v, float) { static_cast<ObjBuilder*>(b)->add_uv({u, v}); };
    result.index_cb = [](void* b, tinyobj::index_t* corners, int count) {
        static_cast<ObjBuilder*>(b)->add_face(corners, count);
    };
    return result;
}

Mesh parse(std::istream& stream) {
    ObjBuilder builder(scan(stream));
    std::string warning;
    std::string error;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks(), &builder, nullptr, &warning, &error))
        throw std::runtime_error(error.empty() ? "not an OBJ file" : error);
    return builder.finish();
}

} // namespace

Mesh read_obj(const std::filesystem::path& file) {
    std::ifstream stream = open_file(file);
    return parse(stream);
}

Mesh parse_obj(const std::string& text) {
    std::istringstream stream(text);
    return parse(stream);
}

} // namespace tessera
