// Smooth normals that keep sharp edges.
#include "render/mesh/meshes.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

glm::vec3 face_normal(const Mesh& mesh, std::size_t i) {
    const glm::uvec3 t = mesh.triangles[i];
    return glm::normalize(
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
}

/// Returns two quads that share vertices, folded along the y axis by `angle`, in degrees.
Mesh folded(float angle) {
    const float a = glm::radians(angle);
    Mesh mesh;
    mesh.positions = {{-1, 0, 0}, {0, 0, 0}, {std::cos(a), 0, -std::sin(a)},
                      {-1, 1, 0}, {0, 1, 0}, {std::cos(a), 1, -std::sin(a)}};
    mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
    return mesh;
}

TEST(Smoothing, SplitsSharpEdgesOnly) {
    Mesh sharp = folded(50);
    sharp.uvs = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
    sharp.attributes = {{"vertex_a", {Rgb(0), Rgb(1), Rgb(2), Rgb(3), Rgb(4), Rgb(5)}},
                        {"face_a", {Rgb(0), Rgb(1), Rgb(2), Rgb(3)}}};
    const Mesh before = sharp;
    smooth_normals(sharp, 45);
    EXPECT_EQ(sharp.positions.size(), 8u); // the two vertices on the fold are split
    EXPECT_EQ(sharp.attribute("face_a")->values.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
        for (int j = 0; j < 3; ++j) {
            const auto was = before.triangles[i][j], is = sharp.triangles[i][j];
            EXPECT_LT(glm::distance(sharp.normals[is], face_normal(sharp, i)), 1e-6f);
            EXPECT_EQ(sharp.positions[is], before.positions[was]);
            EXPECT_EQ(sharp.uvs[is], before.uvs[was]);
            EXPECT_EQ(sharp.attributes[0].values[is], before.attributes[0].values[was]);
        }

    Mesh smooth = folded(50), plain = folded(50);
    smooth_normals(smooth, 55);
    compute_normals(plain);
    EXPECT_EQ(smooth.positions.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_LT(glm::distance(smooth.normals[i], plain.normals[i]), 1e-6f);
}

TEST(Smoothing, TreatsCoincidentVerticesAsShared) {
    Mesh mesh; // the same fold without shared vertices
    const Mesh shared = folded(50);
    for (const glm::uvec3 t : shared.triangles) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.triangles.push_back({first, first + 1, first + 2});
        for (int j = 0; j < 3; ++j)
            mesh.positions.push_back(shared.positions[t[j]]);
    }
    Mesh plain = shared;
    compute_normals(plain);
    smooth_normals(mesh, 55);
    EXPECT_EQ(mesh.positions.size(), 12u);
    for (std::size_t i = 0; i < 4; ++i)
        for (int j = 0; j < 3; ++j)
            EXPECT_LT(glm::distance(mesh.normals[mesh.triangles[i][j]], plain.normals[shared.triangles[i][j]]),
                      1e-6f);
}

TEST(Smoothing, KeepsTheEdgesOfACubeAndSmoothsASphere) {
    Mesh cube = make_cube();
    smooth_normals(cube, 30);
    for (std::size_t i = 0; i < cube.triangles.size(); ++i)
        for (int j = 0; j < 3; ++j)
            EXPECT_LT(glm::distance(cube.normals[cube.triangles[i][j]], face_normal(cube, i)), 1e-6f);
    smooth_normals(cube, 91);
    for (std::size_t i = 0; i < cube.positions.size(); ++i)
        EXPECT_GT(glm::dot(cube.normals[i], glm::normalize(cube.positions[i])), 0.9f);
    Mesh sphere = test::sphere_mesh({0, 0, 0}, 1, 96);
    smooth_normals(sphere, 30);
    float smallest_cosine = 1; // excludes triangles without area at the poles
    for (std::size_t i = 0; i < sphere.triangles.size(); ++i)
        for (int j = 0; j < 3 && glm::length(front_normal(sphere, sphere.triangles[i])) > 0; ++j) {
            const auto corner = sphere.triangles[i][j];
            smallest_cosine = std::min(smallest_cosine,
                                       glm::dot(sphere.normals[corner], glm::normalize(sphere.positions[corner])));
        }
    EXPECT_GT(smallest_cosine, 0.99f);
}

TEST(Smoothing, AcceptsDegenerateTrianglesAndEmptyMeshes) {
    Mesh mesh;
    smooth_normals(mesh, 30);
    EXPECT_TRUE(mesh.normals.empty());
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
    mesh.triangles = {{0, 1, 2}, {0, 0, 0}};
    smooth_normals(mesh, 30);
    for (const glm::vec3 n : mesh.normals)
        EXPECT_NEAR(glm::length(n), 1, 1e-6f);
}

} // namespace

} // namespace tessera
