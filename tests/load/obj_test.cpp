#include "render/mesh/meshes.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

Mesh mesh_of(const std::string& text) {
    return parse_obj(text).mesh;
}

std::string error_of(const std::string& text) {
    try {
        parse_obj(text);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "no error";
}

const std::string square = "# a comment\r\nmtllib none.mtl\no thing\ng group\nusemtl stuff\ns off\n"
                           "v 0 0 0\nv 1 0 0\n  v 1 1 0 1.0\nv 0 1 0 # last\nvt 0 0\nvt 1 0\nvt 1 1 0\nvt 0 1\n"
                           "vn 0 0 2\n";

} // namespace

TEST(Obj, PolygonsBecomeFans) {
    const Mesh mesh = mesh_of(square + "f 1/1/1 2/2/1 3/3/1 4/4/1\n");
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(4, {0, 0, 2}));
    EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Obj, IndicesCountFromBothEnds) {
    const Mesh mesh = mesh_of(square + "f -4//-1 -3//-1 -2//-1\nf 1 3 4\n");
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.positions[mesh.triangles[0].z], glm::vec3(1, 1, 0));
    // A position used with and without a normal becomes two vertices.
    EXPECT_EQ(mesh.positions.size(), 6u);
    EXPECT_NE(mesh.triangles[1].x, mesh.triangles[0].x);
}

TEST(Obj, ReadsPolygonsOfManyCorners) {
    std::string text;
    std::string face = "f";
    for (int i = 0; i < 1000; ++i) {
        text += "v " + std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
        face += " " + std::to_string(i + 1);
    }
    EXPECT_EQ(mesh_of(text + face + "\n").triangles.size(), 998u);
}

TEST(Obj, ReportsErrors) {
    EXPECT_EQ(error_of(square + "f 1 2 5\n"), "face 1 refers to position 5, but there are 4 before it");
    EXPECT_EQ(error_of(square + "f 1 2 0\n"), "face 1 refers to position 0, but there are 4 before it");
    EXPECT_EQ(error_of(square + "f 1 2 -5\n"), "face 1 refers to position -5, but there are 4 before it");
    EXPECT_EQ(error_of(square + "f 1/1 2/2 3/5\n"),
              "face 1 refers to texture coordinate 5, but there are 4 before it");
    EXPECT_EQ(error_of(square + "f 1//1 2//1 3//2\n"), "face 1 refers to normal 2, but there are 1 before it");
    EXPECT_EQ(error_of("v 0 0 0\nv 0 oops 0\n"), "line 2: not a list of 3 numbers or more");
    EXPECT_EQ(error_of("v 0 0\n"), "line 1: not a list of 3 numbers or more");
    EXPECT_EQ(error_of("\n\nvt x\n"), "line 3: not a list of 1 numbers or more");
    EXPECT_EQ(error_of(""), "no error");
}

TEST(Obj, EveryTruncationThrowsOrLoads) {
    const std::string whole = square + "f 1/1/1 2/2/1 3/3/1 4/4/1\n";
    for (std::size_t length = 0; length <= whole.size(); ++length) {
        const Mesh mesh = [&] {
            try {
                return mesh_of(whole.substr(0, length));
            } catch (const std::runtime_error&) {
                return Mesh{};
            }
        }();
        for (glm::uvec3 t : mesh.triangles)
            EXPECT_TRUE(t.x < mesh.positions.size() && t.y < mesh.positions.size() && t.z < mesh.positions.size());
    }
}

TEST(MeshTools, NormalsTransformByTheInverseTranspose) {
    Mesh mesh = mesh_of("v 0 0 0\nv 1 0 -1\nv 0 1 0\nvn 1 0 1\nf 1//1 2//1 3//1\n");
    MeshPlacement placement;
    placement.to_world[0][0] = 4; // stretched along x
    EXPECT_EQ(place_mesh(mesh, placement), "");
    const glm::vec3 expected = glm::normalize(glm::vec3(0.25f, 0, 1));
    EXPECT_NEAR(glm::dot(mesh.normals[0], expected), 1, 1e-6);
    EXPECT_NEAR(glm::dot(front_normal(mesh, mesh.triangles[0]), expected), 1, 1e-6);

    placement.to_world[0][0] = -4; // stretched and mirrored, which keeps the outside outside
    mesh = mesh_of("v 0 0 0\nv 1 0 -1\nv 0 1 0\nvn 1 0 1\nf 1//1 2//1 3//1\n");
    place_mesh(mesh, placement);
    EXPECT_NEAR(glm::dot(front_normal(mesh, mesh.triangles[0]), glm::normalize(glm::vec3(-0.25f, 0, 1))), 1, 1e-6);
}

TEST(MeshTools, ComputesMissingNormals) {
    const std::string roof = "v 0 0 0\nv 0 1 0\nv -1 0 -1\nv -1 1 -1\nv 1 0 -1\nv 1 1 -1\n"
                             "f 1 2 4 3\nf 2 1 5 6\n"; // a roof whose ridge, on top, is along y
    Mesh mesh = mesh_of(roof);
    EXPECT_EQ(place_mesh(mesh, {}), "");
    EXPECT_NEAR(mesh.normals[0].z, 1, 1e-6); // at the ridge, the mean of both sides
    EXPECT_NEAR(mesh.normals[2].x, -std::sqrt(0.5f), 1e-6);

    mesh = mesh_of(roof);
    MeshPlacement flat;
    flat.face_normals = true;
    place_mesh(mesh, flat);
    EXPECT_TRUE(mesh.normals.empty());

    mesh = mesh_of("vn 0 0 0\nvn 0 0 1\n" + roof + "f 1//1 2//2 4//2\n");
    EXPECT_EQ(place_mesh(mesh, {}), "7 normals without a direction replaced by computed ones");
    for (glm::vec3 n : mesh.normals)
        EXPECT_NEAR(glm::length(n), 1, 1e-6);
}

TEST(MeshTools, FlippedAndEmptyMeshes) {
    Mesh mesh = mesh_of(square + "f 1 2 3\n");
    MeshPlacement placement;
    placement.flip_normals = true;
    placement.face_normals = true;
    place_mesh(mesh, placement);
    EXPECT_EQ(front_normal(mesh, mesh.triangles[0]), glm::vec3(0, 0, -1));

    Mesh empty = mesh_of("v 0 0 0\n");
    EXPECT_EQ(place_mesh(empty, {}), "there are no triangles in it");
}

} // namespace tessera
