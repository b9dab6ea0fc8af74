#include "render/load/mesh_files.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include <tiny_obj_loader.h>

namespace tessera {

namespace {

constexpr std::string_view gaps = " \t\r";

/// How many numbers a line lists; 0 when something in it cannot be part of one ("nan", "1,5").
std::size_t count_numbers(std::string_view list) {
    list = list.substr(0, list.find('#'));
    if (list.find_first_not_of("0123456789+-.eE \t\r") != std::string_view::npos)
        return 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const bool in_gap = gaps.find(list[i]) != std::string_view::npos;
        const bool after_gap = i == 0 || gaps.find(list[i - 1]) != std::string_view::npos;
        count += !in_gap && after_gap;
    }
    return count;
}

/// tinyobjloader takes what is no number for 0, so the lines of numbers are looked through before it gets them.
void check_numbers(std::string_view text) {
    for (std::size_t line = 1, begin = 0; begin < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string_view rest = text.substr(begin, end - begin);
        begin = end + 1;
        rest.remove_prefix(std::min(rest.find_first_not_of(gaps), rest.size()));
        const std::size_t name_end = std::min(rest.find_first_of(gaps), rest.size());
        const std::string_view name = rest.substr(0, name_end);
        const std::size_t needed = name == "v" || name == "vn" ? 3 : name == "vt" ? 1 : 0;
        if (needed > 0 && count_numbers(rest.substr(name_end)) < needed)
            throw std::runtime_error("line " + std::to_string(line) + ": not a list of " + std::to_string(needed) +
                                     " numbers or more");
    }
}

/// Gathers what tinyobjloader reports, and makes one vertex of each combination of indices in use.
class ObjBuilder {
public:
    void add_position(glm::vec3 p) {
        positions_.push_back(p);
        first_of_.push_back(none);
    }
    void add_normal(glm::vec3 n) { normals_.push_back(n); }
    void add_uv(glm::vec2 uv) { uvs_.push_back(uv); }

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
        mesh_.positions.reserve(vertices_.size());
        for (const Vertex& v : vertices_) {
            mesh_.positions.push_back(positions_[v.position]);
            if (!normals_.empty())
                mesh_.normals.push_back(v.normal == none ? glm::vec3(0) : normals_[v.normal]);
            if (!uvs_.empty())
                mesh_.uvs.push_back(v.uv == none ? glm::vec2(0) : uvs_[v.uv]);
        }
        return std::move(mesh_);
    }

private:
    static constexpr unsigned none = ~0u;

    struct Vertex {
        unsigned position, uv, normal;
        unsigned next; // another vertex at the same position
    };

    unsigned index(int from_file, std::size_t count, const char* what) const {
        // 1 is the first so far, -1 the last so far.
        const long long i = from_file > 0 ? from_file - 1ll : static_cast<long long>(count) + from_file;
        if (from_file == 0 || i < 0 || i >= static_cast<long long>(count))
            throw std::runtime_error("face " + std::to_string(faces_) + " refers to " + what + " " +
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
        for (unsigned v = first_of_[position]; v != none; v = vertices_[v].next)
            if (vertices_[v].uv == uv && vertices_[v].normal == normal)
                return v;
        const auto added = static_cast<unsigned>(vertices_.size());
        vertices_.push_back({position, uv, normal, first_of_[position]});
        first_of_[position] = added;
        return added;
    }

    std::vector<glm::vec3> positions_;
    std::vector<glm::vec3> normals_;
    std::vector<glm::vec2> uvs_;
    std::vector<Vertex> vertices_;
    std::vector<unsigned> first_of_; // by position, an index of vertices_
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

} // namespace

Mesh parse_obj(std::string text) {
    check_numbers(text);
    ObjBuilder builder;
    std::istringstream stream(std::move(text));
    std::string warning;
    std::string error;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks(), &builder, nullptr, &warning, &error))
        throw std::runtime_error(error.empty() ? "not an OBJ file" : error);
    return builder.finish();
}

} // namespace tessera
