#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/mesh/meshes.h"
#include "render/mesh/obj_scan.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <tiny_obj_loader.h>

namespace tessera {

namespace {

/// Collects what tinyobjloader reports, and makes one vertex of each combination of indices in use.
class ObjBuilder {
public:
    explicit ObjBuilder(const ObjScan& counts) : scan_(counts) {
        // Memory peaks in finish(), which makes the mesh from the lists; normals are given or computed.
        const std::size_t vertex_bytes = 3 * sizeof(glm::vec3) + sizeof(ObjVertex) + sizeof(unsigned) +
                                         (counts.uvs > 0 ? sizeof(glm::vec2) : 0);
        require_memory(counts.positions * vertex_bytes + counts.normals * sizeof(glm::vec3) +
                           counts.uvs * sizeof(glm::vec2) + counts.triangles * sizeof(glm::uvec3) +
                           counts.polygons * sizeof(PolygonFan),
                       "its " + std::to_string(counts.positions) + " vertices and " +
                           std::to_string(counts.triangles) + " triangles");
        positions_.reserve(counts.positions);
        first_vertex_.reserve(counts.positions);
        vertices_.reserve(counts.positions); // at least as many, if every position is used
        normals_.reserve(counts.normals);
        uvs_.reserve(counts.uvs);
        mesh_.triangles.reserve(counts.triangles);
        polygons_.reserve(counts.polygons);
    }

    void add_position(glm::vec3 p) {
        positions_.push_back(p);
        first_vertex_.push_back(none);
    }
    void add_normal(glm::vec3 n) { normals_.push_back(n); }
    void add_uv(glm::vec2 uv) { uvs_.push_back(uv); }

    void add_face(const tinyobj::index_t* corners, int count) {
        ++faces_;
        if (count < 3) {
            ++small_faces_;
            return;
        }
        if (count > 3)
            polygons_.push_back({mesh_.triangles.size(), static_cast<std::size_t>(count)});
        const unsigned first = vertex(corners[0]);
        unsigned previous = vertex(corners[1]);
        for (int i = 2; i < count; ++i) {
            const unsigned current = vertex(corners[i]);
            mesh_.triangles.push_back({first, previous, current});
            previous = current;
        }
    }

    void begin_part(const std::string& name, const std::string& material) {
        end_part();
        part_ = {name, material, mesh_.triangles.size(), 0};
    }
    void set_name(const std::string& name) { begin_part(name, part_.material); }
    void set_material(const std::string& material) { begin_part(part_.name, material); }

    MeshFile finish() {
        mark_broken();
        end_part();
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
        MeshFile file;
        file.report = report();
        if (const std::size_t uncut = cut_polygons(mesh_, polygons_))
            file.report.ignored.push_back("the shape of " + counted(uncut, "face") + " whose edges cross or are too many");
        drop_broken(file);
        file.parts = std::move(parts_);
        file.mesh = std::move(mesh_);
        return file;
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

    void end_part() {
        part_.triangles = mesh_.triangles.size() - part_.first_triangle;
        if (part_.triangles > 0)
            parts_.push_back(part_);
    }

    void mark_broken() {
        const auto mark = [](auto& values, const std::vector<std::size_t>& broken) {
            for (const std::size_t i : broken)
                if (i < values.size())
                    values[i].x = std::numeric_limits<float>::quiet_NaN();
        };
        mark(positions_, scan_.broken_positions);
        mark(normals_, scan_.broken_normals);
        mark(uvs_, scan_.broken_uvs);
    }

    /// Repairs the mesh. Triangles are removed from the parts that have them.
    void drop_broken(MeshFile& file) {
        std::vector<std::size_t> kept{0}; // triangles kept before each triangle
        for (const glm::uvec3& t : mesh_.triangles)
            kept.push_back(kept.back() + (is_finite(t.x) && is_finite(t.y) && is_finite(t.z)));
        for (MeshPart& part : parts_) {
            const std::size_t end = kept[part.first_triangle + part.triangles];
            part.first_triangle = kept[part.first_triangle];
            part.triangles = end - part.first_triangle;
        }
        for (std::string& error : repair_mesh(mesh_))
            file.report.errors.push_back(std::move(error));
    }

    bool is_finite(std::uint32_t vertex) const {
        const glm::vec3 p = mesh_.positions[vertex];
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    }

    FileReport report() const {
        FileReport report;
        report.contents = {counted(scan_.positions, "position"), counted(faces_, "face")};
        if (scan_.normals > 0)
            report.contents.push_back(counted(scan_.normals, "normal"));
        if (scan_.uvs > 0)
            report.contents.push_back(counted(scan_.uvs, "texture coordinate"));
        std::set<std::string> materials;
        for (const MeshPart& part : parts_)
            if (!part.material.empty())
                materials.insert(part.material);
        if (parts_.size() > 1)
            report.contents.push_back(counted(parts_.size(), "part"));
        if (!materials.empty())
            report.contents.push_back(counted(materials.size(), "material"));
        if (scan_.colors > 0)
            report.ignored.emplace_back("the colours of " + std::to_string(scan_.colors) + " vertices");
        if (small_faces_ > 0)
            report.ignored.push_back(counted(small_faces_, "face") + " with fewer than 3 corners");
        for (const auto& [name, lines] : scan_.unknown)
            report.ignored.push_back(counted(lines, "line") + " of '" + name + "'");
        return report;
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
    ObjScan scan_;
    std::vector<PolygonFan> polygons_;
    std::vector<MeshPart> parts_;
    MeshPart part_; // being read
    std::size_t faces_ = 0, small_faces_ = 0;
    Mesh mesh_;
};

std::string trim(std::string_view text) {
    constexpr std::string_view white_space = " \t\r";
    text.remove_prefix(std::min(text.find_first_not_of(white_space), text.size()));
    return std::string(text.substr(0, text.find_last_not_of(white_space) + 1));
}

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
    result.usemtl_cb = [](void* b, const char* name, int) {
        static_cast<ObjBuilder*>(b)->set_material(trim(name));
    };
    result.object_cb = [](void* b, const char* name) { static_cast<ObjBuilder*>(b)->set_name(trim(name)); };
    result.group_cb = [](void* b, const char** names, int count) {
        static_cast<ObjBuilder*>(b)->set_name(count > 0 ? names[0] : "");
    };
    return result;
}

MeshFile parse(std::istream& stream) {
    const ObjScan scan = scan_obj(stream);
    if (scan.has_continuation) {
        std::istringstream joined(join_lines(stream));
        return parse(joined);
    }
    ObjBuilder builder(scan);
    std::string warning;
    std::string error;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks(), &builder, nullptr, &warning, &error))
        throw std::runtime_error(error.empty() ? "not an OBJ file" : error);
    return builder.finish();
}

} // namespace

MeshFile read_obj(const std::filesystem::path& file) {
    std::ifstream stream = open_file(file);
    return parse(stream);
}

MeshFile parse_obj(const std::string& text) {
    std::istringstream stream(text);
    return parse(stream);
}

} // namespace tessera
