// Faces that are not convex are cut into triangles that cover them exactly.

#include "render/mesh/meshes.h"
#include "tests/load/mesh_area.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

using test::area_of;
using Outline = std::vector<glm::vec2>;

/// Returns the area of a polygon by the shoelace formula.
double shoelace(const Outline& outline) {
    double sum = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
        sum += (a.x * b.y - a.y * b.x) / 2;
    }
    return std::abs(sum);
}

/// Returns an OBJ file with one face, whose corners are in the plane z = x / 2 + y.
std::string obj_of(const Outline& outline) {
    std::string text, face = "f";
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::vec2 p = outline[i];
        text +=
            "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.x / 2 + p.y) + "\n";
        face += " " + std::to_string(i + 1);
    }
    return text + face + "\n";
}

constexpr double slope = 1.5; // area on the plane over area of its projection to xy: length of (1/2, 1, -1)

const Outline letter_u = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
const Outline arrow = {{0, 0}, {2, 1}, {0, 2}, {1, 1}};                               // reflex at its last corner
const Outline bar = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {2, 1}, {1, 1}, {0, 1}}; // corners in line
// A square with a square hole, connected by a doubled edge.
const Outline frame = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};

Outline star(int points) {
    Outline outline;
    for (int i = 0; i < 2 * points; ++i) {
        const double angle = std::numbers::pi * i / points, radius = i % 2 == 0 ? 1 : 0.3;
        outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return outline;
}

} // namespace

TEST(Polygons, ConcaveFacesHaveTheirArea) {
    for (const Outline& outline : {letter_u, arrow, bar, frame, star(5), star(40)})
        for (std::size_t first = 0; first < outline.size(); ++first) { // whichever corner the file begins with
            Outline turned(outline.begin() + static_cast<std::ptrdiff_t>(first), outline.end());
            turned.insert(turned.end(), outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(first));
            const MeshFile file = parse_obj(obj_of(turned));
            EXPECT_EQ(file.mesh.triangles.size(), outline.size() - 2);
            EXPECT_NEAR(area_of(file.mesh), slope * shoelace(outline), 1e-5 * shoelace(outline))
                << outline.size() << " corners, from " << first;
            EXPECT_TRUE(file.report.ignored.empty());
        }
}

TEST(Polygons, TrianglesKeepTheSideOfTheFace) {
    Outline reversed(letter_u.rbegin(), letter_u.rend());
    for (const bool is_reversed : {false, true}) {
        const Mesh mesh = parse_obj(obj_of(is_reversed ? reversed : letter_u)).mesh;
        for (const glm::uvec3 t : mesh.triangles)
            EXPECT_EQ(front_normal(mesh, t).z > 0, !is_reversed);
    }
}

TEST(Polygons, CornersInLineAreKept) {
    const Mesh mesh = parse_obj(obj_of(bar)).mesh;
    for (const glm::uvec3 t : mesh.triangles)
        EXPECT_GT(glm::length(front_normal(mesh, t)), 0.5f); // none without area
}

TEST(Polygons, CrossingEdgesAreReported) {
    const MeshFile file = parse_obj(obj_of({{0, 0}, {1, 1}, {1, 0}, {0, 2}}));
    EXPECT_EQ(file.mesh.triangles.size(), 2u);
    ASSERT_EQ(file.report.ignored.size(), 1u);
    EXPECT_EQ(file.report.ignored[0], "the shape of 1 face whose edges cross or are too many");
}

TEST(Polygons, PlyFacesThatPrecedeVerticesAreCut) {
    std::string vertices, face = std::to_string(letter_u.size());
    for (std::size_t i = 0; i < letter_u.size(); ++i) {
        vertices += std::to_string(letter_u[i].x) + " " + std::to_string(letter_u[i].y) + " 0\n";
        face += " " + std::to_string(i);
    }
    const Mesh mesh = parse_ply("ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_indices\n"
                                "element vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
                                "end_header\n" +
                                face + "\n" + vertices)
                          .mesh;
    EXPECT_NEAR(area_of(mesh), shoelace(letter_u), 1e-5);
}

} // namespace tessera
