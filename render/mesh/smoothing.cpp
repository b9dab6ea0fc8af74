#include "render/mesh/meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

/// Disjoint sets of triangle corners that share a normal. Corner 3 i + j is triangles[i][j].
class Groups {
public:
    explicit Groups(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }

    std::size_t of(std::size_t corner) {
        while (parent_[corner] != corner)
            corner = parent_[corner] = parent_[parent_[corner]];
        return corner;
    }
    void join(std::size_t a, std::size_t b) {
        const std::size_t group_a = of(a), group_b = of(b);
        parent_[std::max(group_a, group_b)] = std::min(group_a, group_b);
    }

private:
    std::vector<std::size_t> parent_;
};

/// Returns a number for each vertex that is equal for vertices at the same position.
std::vector<std::uint32_t> places_of(const Mesh& mesh) {
    std::vector<std::uint32_t> order(mesh.positions.size()), place(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) {
        const glm::vec3 p = mesh.positions[i];
        return std::tuple(p.x, p.y, p.z);
    };
    std::ranges::sort(order, {}, key);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool is_same = i > 0 && key(order[i]) == key(order[i - 1]);
        place[order[i]] = is_same ? place[order[i - 1]] : order[i];
    }
    return place;
}

/// Returns the unit normal of a triangle; 0 if it has no area.
glm::vec3 face_normal(const Mesh& mesh, glm::uvec3 t) {
    const glm::dvec3 corner = mesh.positions[t.x];
    const glm::dvec3 cross =
        glm::cross(glm::dvec3(mesh.positions[t.y]) - corner, glm::dvec3(mesh.positions[t.z]) - corner);
    const double length = glm::length(cross);
    return length > 0 ? glm::vec3(cross / length) : glm::vec3(0);
}

/// One end of an edge of a triangle.
struct EdgeEnd {
    std::uint32_t place, other; // places (see places_of) of this end and of the other end
    std::size_t corner;
};

std::vector<EdgeEnd> edge_ends_of(const Mesh& mesh, const std::vector<std::uint32_t>& place) {
    std::vector<EdgeEnd> ends;
    ends.reserve(6 * mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int j = 0; j < 3; ++j)
            for (const int k : {(j + 1) % 3, (j + 2) % 3})
                ends.push_back({place[mesh.triangles[i][j]], place[mesh.triangles[i][k]],
                                3 * i + static_cast<std::size_t>(j)});
    std::ranges::sort(ends, {}, [](const EdgeEnd& e) { return std::tie(e.place, e.other, e.corner); });
    return ends;
}

/// Joins corners across each edge whose face normals differ by at most the angle (degrees).
Groups smooth_groups(const Mesh& mesh, float max_angle) {
    const float min_cos = std::cos(glm::radians(max_angle));
    Groups groups(3 * mesh.triangles.size());
    const std::vector<EdgeEnd> ends = edge_ends_of(mesh, places_of(mesh));
    for (std::size_t i = 1; i < ends.size(); ++i) {
        const EdgeEnd &a = ends[i - 1], &b = ends[i];
        if (a.place != b.place || a.other != b.other)
            continue;
        const glm::vec3 normal_a = face_normal(mesh, mesh.triangles[a.corner / 3]),
                        normal_b = face_normal(mesh, mesh.triangles[b.corner / 3]);
        if (glm::dot(normal_a, normal_b) >= min_cos)
            groups.join(a.corner, b.corner);
    }
    return groups;
}

/// Gives every group its own copy of each vertex that several groups use.
void split_vertices(Mesh& mesh, Groups& groups) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::tuple<std::uint32_t, std::size_t, std::size_t>> uses; // vertex, group, corner
    for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c)
        uses.emplace_back(mesh.triangles[c / 3][static_cast<int>(c % 3)], groups.of(c), c);
    std::ranges::sort(uses);
    const auto copy = [](auto& values, std::uint32_t i) {
        if (!values.empty())
            values.push_back(values[i]);
    };
    std::uint32_t vertex = none, target = none;
    std::size_t group = 0;
    for (const auto& [from, of, corner] : uses) {
        if (from != vertex) { // the first group keeps the original
            target = from;
        } else if (of != group) {
            target = static_cast<std::uint32_t>(mesh.positions.size());
            copy(mesh.positions, from);
            copy(mesh.uvs, from);
            for (MeshAttribute& attribute : mesh.attributes)
                if (!attribute.is_of_faces())
                    copy(attribute.values, from);
        }
        vertex = from;
        group = of;
        mesh.triangles[corner / 3][static_cast<int>(corner % 3)] = target;
    }
}

} // namespace

void smooth_normals(Mesh& mesh, float max_angle) {
    Groups groups = smooth_groups(mesh, max_angle);
    mesh.normals.clear();
    split_vertices(mesh, groups);
    // Vertices of one group, as along a seam of texture coordinates, share a normal. So normals are computed on
    // a mesh with one vertex per group.
    Mesh joined;
    joined.positions.resize(3 * mesh.triangles.size());
    joined.triangles.resize(mesh.triangles.size());
    for (std::size_t c = 0; c < joined.positions.size(); ++c) {
        const int j = static_cast<int>(c % 3);
        const auto group = static_cast<std::uint32_t>(groups.of(c));
        joined.positions[group] = mesh.positions[mesh.triangles[c / 3][j]];
        joined.triangles[c / 3][j] = group;
    }
    compute_normals(joined);
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
    for (std::size_t c = 0; c < joined.positions.size(); ++c)
        mesh.normals[mesh.triangles[c / 3][static_cast<int>(c % 3)]] = joined.normals[groups.of(c)];
}

} // namespace tessera
