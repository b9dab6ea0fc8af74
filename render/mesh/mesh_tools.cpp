#include "render/mesh/meshes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace tessera {

namespace {

bool is_finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_unit(glm::vec3 v) {
    return std::abs(glm::dot(v, v) - 1) < 1e-3f;
}

void transform_positions(Mesh& mesh, const glm::mat4& to_world) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.positions[i] = glm::vec3(to_world * glm::vec4(mesh.positions[i], 1));
        if (!is_finite(mesh.positions[i]))
            throw std::runtime_error("the position of vertex " + std::to_string(i) + " is not finite");
    }
}

/// Transforms normals to unit length, or to 0 if they have no direction.
void transform_normals(Mesh& mesh, const glm::mat4& to_world) {
    glm::mat3 matrix = normal_matrix(glm::mat3(to_world));
    float largest = 0;
    for (int i = 0; i < 9; ++i)
        largest = std::max(largest, std::abs(matrix[i / 3][i % 3]));
    if (largest > 0) // cofactors of small scales may underflow
        matrix /= largest;
    for (glm::vec3& normal : mesh.normals) {
        const glm::vec3 n = matrix * normal;
        const float length = glm::length(n);
        normal = length > 0 && std::isfinite(length) ? n / length : glm::vec3(0);
    }
}

void flip(Mesh& mesh) {
    for (glm::uvec3& triangle : mesh.triangles)
        std::swap(triangle.y, triangle.z);
    for (glm::vec3& normal : mesh.normals)
        normal = -normal;
}

float angle_between(glm::vec3 a, glm::vec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Replaces normals without a direction by computed ones. Returns how many were replaced.
std::size_t repair_normals(Mesh& mesh) {
    const auto broken = static_cast<std::size_t>(
        std::count_if(mesh.normals.begin(), mesh.normals.end(), [](glm::vec3 n) { return !is_unit(n); }));
    if (broken == 0)
        return 0;
    std::vector<glm::vec3> given = std::move(mesh.normals);
    compute_normals(mesh);
    for (std::size_t i = 0; i < given.size(); ++i)
        if (is_unit(given[i]))
            mesh.normals[i] = given[i];
    return broken;
}

} // namespace

void compute_normals(Mesh& mesh) {
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0));
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::vec3 corners[3] = {mesh.positions[triangle.x], mesh.positions[triangle.y],
                                      mesh.positions[triangle.z]};
        const glm::vec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const float length = glm::length(cross);
        if (!(length > 0) || !std::isfinite(length))
            continue;
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 corner = corners[i];
            const float angle = angle_between(corners[(i + 1) % 3] - corner, corners[(i + 2) % 3] - corner);
            mesh.normals[triangle[i]] += cross / length * angle;
        }
    }
    for (glm::vec3& normal : mesh.normals) {
        const float length = glm::length(normal);
        normal = length > 1e-6f ? normal / length : glm::vec3(0, 0, 1);
    }
}

std::string place_mesh(Mesh& mesh, const MeshPlacement& placement) {
    std::string error;
    transform_positions(mesh, placement.to_world);
    if (placement.face_normals) {
        mesh.normals.clear();
    } else if (placement.max_smooth_angle) {
        smooth_normals(mesh, *placement.max_smooth_angle);
    } else if (mesh.normals.empty()) {
        compute_normals(mesh);
    } else {
        transform_normals(mesh, placement.to_world);
        if (const std::size_t broken = repair_normals(mesh))
            error = counted(broken, "normal") + " without a direction replaced by computed ones";
    }
    if (placement.flip_normals)
        flip(mesh);
    if (mesh.triangles.empty())
        error = "there are no triangles in it";
    return error;
}

void place_flat_mesh(Mesh& mesh, const MeshPlacement& placement) {
    transform_positions(mesh, placement.to_world);
    const bool mirrored = glm::determinant(glm::mat3(placement.to_world)) < 0;
    if (mirrored != placement.flip_normals)
        flip(mesh);
}

} // namespace tessera
