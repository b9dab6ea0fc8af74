#include "render/mesh/mesh_file.h"

#include "render/io/available_memory.h"
#include "render/io/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

template <class Vector>
bool is_finite(const Vector& v) {
    for (int i = 0; i < v.length(); ++i)
        if (!std::isfinite(v[i]))
            return false;
    return true;
}

/// Sets vectors that are not finite to 0. Returns how many there were.
template <class Vector>
std::size_t zero_non_finite(std::vector<Vector>& values) {
    std::size_t count = 0;
    for (Vector& value : values)
        if (!is_finite(value)) {
            value = Vector(0);
            ++count;
        }
    return count;
}

/// Removes the triangles that a predicate on their index selects, with their attributes.
template <class Predicate>
std::size_t remove_triangles(Mesh& mesh, Predicate is_removed) {
    std::size_t kept = 0;
    const std::size_t count = mesh.triangles.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (is_removed(i))
            continue;
        mesh.triangles[kept] = mesh.triangles[i];
        for (MeshAttribute& attribute : mesh.attributes)
            if (attribute.is_of_faces())
                attribute.values[kept] = attribute.values[i];
        ++kept;
    }
    mesh.triangles.resize(kept);
    for (MeshAttribute& attribute : mesh.attributes)
        if (attribute.is_of_faces())
            attribute.values.resize(kept);
    return count - kept;
}

/// Appends a copy of a vertex, without its texture coordinates. Returns its index.
std::uint32_t copy_vertex(Mesh& mesh, std::uint32_t vertex) {
    const auto copy = [vertex](auto& values) {
        if (!values.empty())
            values.push_back(values[vertex]);
    };
    copy(mesh.positions);
    copy(mesh.normals);
    for (MeshAttribute& attribute : mesh.attributes)
        if (!attribute.is_of_faces())
            copy(attribute.values);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

} // namespace

void set_corner_uvs(Mesh& mesh, std::span<const glm::vec2> corner_uvs) {
    std::vector<std::uint32_t> next(mesh.positions.size(), none); // another copy of the same vertex
    std::vector<bool> is_used(mesh.positions.size());
    mesh.uvs.assign(mesh.positions.size(), glm::vec2(0));
    const auto vertex_with = [&](std::uint32_t vertex, glm::vec2 uv) {
        if (!is_used[vertex]) {
            is_used[vertex] = true;
            mesh.uvs[vertex] = uv;
            return vertex;
        }
        while (mesh.uvs[vertex] != uv) {
            if (next[vertex] == none) {
                if (mesh.positions.size() >= none)
                    throw OutOfMemory("its texture coordinates need more than 2^32 vertices");
                const std::uint32_t added = copy_vertex(mesh, vertex);
                mesh.uvs.push_back(uv);
                next.push_back(none);
                next[vertex] = added;
            }
            vertex = next[vertex];
        }
        return vertex;
    };
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int j = 0; j < 3; ++j)
            mesh.triangles[i][j] =
                vertex_with(mesh.triangles[i][j], corner_uvs[3 * i + static_cast<std::size_t>(j)]);
}

std::vector<std::string> repair_mesh(Mesh& mesh) {
    std::vector<std::string> errors;
    std::vector<bool> is_broken(mesh.positions.size());
    std::size_t broken = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (!is_finite(mesh.positions[i])) {
            is_broken[i] = true;
            mesh.positions[i] = glm::vec3(0);
            ++broken;
        }
    if (broken > 0) {
        const std::size_t lost = remove_triangles(mesh, [&](std::size_t i) {
            const glm::uvec3 t = mesh.triangles[i];
            return is_broken[t.x] || is_broken[t.y] || is_broken[t.z];
        });
        errors.push_back(counted(broken, "position") + " not finite: " + counted(lost, "triangle") + " left out");
    }
    if (const std::size_t count = zero_non_finite(mesh.uvs))
        errors.push_back(counted(count, "texture coordinate") + " not finite: (0, 0) is used");
    for (MeshAttribute& attribute : mesh.attributes)
        if (const std::size_t count = zero_non_finite(attribute.values))
            errors.push_back(counted(count, "value") + " of '" + attribute.name + "' not finite: 0 is used");
    return errors;
}

Mesh mesh_of_parts(const Mesh& mesh, std::span<const MeshPart* const> parts) {
    Mesh result;
    std::vector<std::uint32_t> place(mesh.positions.size(), none);
    const auto vertex_of = [&](std::uint32_t vertex) {
        if (place[vertex] == none) {
            place[vertex] = static_cast<std::uint32_t>(result.positions.size());
            result.positions.push_back(mesh.positions[vertex]);
            if (!mesh.normals.empty())
                result.normals.push_back(mesh.normals[vertex]);
            if (!mesh.uvs.empty())
                result.uvs.push_back(mesh.uvs[vertex]);
        }
        return place[vertex];
    };
    for (const MeshPart* part : parts)
        for (std::size_t i = part->first_triangle; i < part->first_triangle + part->triangles; ++i) {
            const glm::uvec3 t = mesh.triangles[i];
            const std::uint32_t x = vertex_of(t.x), y = vertex_of(t.y), z = vertex_of(t.z);
            result.triangles.emplace_back(x, y, z);
        }
    return result;
}

std::string counted(std::size_t count, std::string_view noun) {
    return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

bool is_non_finite_word(std::string_view word) {
    if (word.starts_with('-') || word.starts_with('+'))
        word.remove_prefix(1);
    const std::string lower = lower_case(word);
    return lower.starts_with("nan") || lower == "inf" || lower == "infinity" || lower.starts_with("1.#");
}

} // namespace tessera
