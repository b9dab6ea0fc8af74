// Parts of mesh files that exporters write and that readers must use or report.

#include "render/mesh/meshes.h"
#include "tests/load/mesh_area.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera {

namespace {

using test::area_of;
using testing::ElementsAre;
using testing::IsEmpty;

const std::string vertex_header = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

MeshFile ply(const std::string& header, const std::string& body) {
    return parse_ply("ply\nformat ascii 1.0\n" + vertex_header + header + "end_header\n" + square + body);
}

/// Returns the texture coordinates of a triangle's corners.
std::vector<glm::vec2> corner_uvs(const Mesh& mesh, std::size_t triangle) {
    const glm::uvec3 t = mesh.triangles.at(triangle);
    return {mesh.uvs.at(t.x), mesh.uvs.at(t.y), mesh.uvs.at(t.z)};
}

} // namespace

TEST(FileReport, PlyCornersHaveTheirOwnTextureCoordinates) {
    const MeshFile file = ply("element face 2\nproperty list uchar int vertex_index\n"
                              "property list uchar float texcoord\nproperty int texnumber\n",
                              "4 0 1 2 3 8 0 0 1 0 1 1 0 1 0\n3 0 1 2 6 0.5 0.5 1 0 0.25 0 0\n");
    ASSERT_EQ(file.mesh.triangles.size(), 3u);
    EXPECT_EQ(corner_uvs(file.mesh, 0), (std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_EQ(corner_uvs(file.mesh, 1), (std::vector<glm::vec2>{{0, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(corner_uvs(file.mesh, 2), (std::vector<glm::vec2>{{0.5f, 0.5f}, {1, 0}, {0.25f, 0}}));
    EXPECT_EQ(file.mesh.positions.size(), 6u); // two of the second face's corners have a vertex of their own
    EXPECT_EQ(file.mesh.positions.at(file.mesh.triangles[2].z), glm::vec3(1, 1, 0));
    EXPECT_THAT(file.report.contents,
                ElementsAre("4 positions", "2 faces", "texture coordinates of face corners"));
    EXPECT_THAT(file.report.ignored, ElementsAre("'texnumber' of 'face'"));
    EXPECT_THAT(file.report.errors, IsEmpty());
}

TEST(FileReport, PlyFacesWithoutCornerCoordinatesAreErrors) {
    const MeshFile file = ply("element face 2\nproperty list uchar float texcoord\n"
                              "property list uchar int vertex_index\n",
                              "0 3 0 1 2\n6 0 nan 1 0 1 1 3 0 2 3\n");
    EXPECT_EQ(corner_uvs(file.mesh, 0), std::vector<glm::vec2>(3, {0, 0}));
    EXPECT_EQ(corner_uvs(file.mesh, 1), (std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_THAT(file.report.errors, ElementsAre("1 face without one texture coordinate per corner: (0, 0) is used",
                                                "1 texture coordinate not finite: (0, 0) is used"));
}

TEST(FileReport, PlyStripsAlternate) {
    // Two strips in one list, and a repeated index that turns a strip over.
    const MeshFile file =
        ply("element tristrips 1\nproperty list int int vertex_indices\n", "10 0 1 3 2 -1 0 0 1 3 2\n");
    EXPECT_THAT(file.mesh.triangles,
                ElementsAre(glm::uvec3(0, 1, 3), glm::uvec3(3, 1, 2), glm::uvec3(1, 0, 3), glm::uvec3(1, 3, 2)));
    EXPECT_EQ(ply("element tristrips 1\nproperty list int int vertex_indices\n", "4 0 1 3 2\n").mesh.triangles,
              (std::vector<glm::uvec3>{{0, 1, 3}, {3, 1, 2}}));
    EXPECT_THAT(file.report.contents, ElementsAre("4 positions", "4 triangles of strips"));
}

TEST(FileReport, PlyReportsWhatHasNoEffect) {
    const MeshFile file = ply("element face 2\nproperty list int int vertex_indices\nproperty float quality\n"
                              "element edge 3\nproperty int a\nproperty int b\n",
                              "4 0 1 2 3 1\n2 0 1 1\n0 1\n1 2\n2 3\n");
    EXPECT_THAT(file.report.ignored, ElementsAre("'quality' of 'face'", "the element 'edge' (3 rows)",
                                                 "1 face with fewer than 3 corners"));
}

TEST(FileReport, PlyAttributeOfSomeFacesIsLeftOut) {
    const MeshFile file = ply("element face 1\nproperty list int int vertex_indices\nproperty uchar red\n"
                              "property uchar green\nproperty uchar blue\n"
                              "element tristrips 1\nproperty list int int vertex_indices\n",
                              "3 0 1 2 255 0 0\n3 0 2 3\n");
    EXPECT_EQ(file.mesh.triangles.size(), 2u);
    EXPECT_THAT(file.mesh.attributes, IsEmpty());
    EXPECT_THAT(file.report.errors, ElementsAre("'face_color' left out: some faces lack it"));
}

TEST(FileReport, PlyValuesThatAreNotFiniteAreZero) {
    const MeshFile file =
        ply("element face 1\nproperty list int int vertex_indices\nproperty float a_0\n", "3 0 1 2 inf\n");
    EXPECT_EQ(file.mesh.attribute("face_a")->values, std::vector<glm::vec3>{glm::vec3(0)});
    EXPECT_THAT(file.report.errors, ElementsAre("1 value of 'face_a' not finite: 0 is used"));
}

TEST(FileReport, ObjLinesContinue) {
    const std::string text =
        "# C:\\models\\\n  # C:\\scenes\\\nv 0 0 0\nv 1 0 \\\n0\nv 1 1 0\r\nv 0 1 0\nf 1 2 \\\r\n3 \\\n4\n";
    EXPECT_DOUBLE_EQ(area_of(parse_obj(text).mesh), 1);
    try {
        parse_obj(text + "v 1 x 0\n");
        FAIL();
    } catch (const std::runtime_error& error) { // the line of the file, not of the joined text
        EXPECT_STREQ(error.what(), "line 11: not a list of 3 numbers or more");
    }
}

TEST(FileReport, ObjReportsWhatHasNoEffect) {
    const MeshFile file = parse_obj("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\nf 1 2\nl 1 2\nl 2 3\n"
                                    "curv 0 1 1 2\n");
    EXPECT_THAT(file.report.contents, ElementsAre("3 positions", "2 faces"));
    EXPECT_THAT(file.report.ignored, ElementsAre("the colours of 3 vertices", "1 face with fewer than 3 corners",
                                                 "1 line of 'curv'", "2 lines of 'l'"));
}

TEST(FileReport, NormalsThatAreNotFiniteAreComputed) {
    MeshFile file = parse_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan 0 0\nvn 0 0 1\nf 1//1 2//2 3//2\n");
    EXPECT_TRUE(std::isnan(file.mesh.normals.at(0).x));
    EXPECT_EQ(place_mesh(file.mesh, {}), "1 normal without a direction replaced by computed ones");
    for (const glm::vec3 normal : file.mesh.normals)
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

} // namespace tessera
