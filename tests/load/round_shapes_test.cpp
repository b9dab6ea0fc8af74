// Triangulated spheres, disks and cylinders: area, distance, normals and UVs against the exact shapes.

#include "render/load/mitsuba_xml.h"
#include "render/mesh/meshes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

constexpr double pi_d = std::numbers::pi;

double area(const Mesh& mesh) {
    double sum = 0;
    for (const glm::uvec3 t : mesh.triangles) {
        const glm::dvec3 corner = mesh.positions[t.x];
        sum += glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - corner,
                                      glm::dvec3(mesh.positions[t.z]) - corner)) /
               2;
    }
    return sum;
}

Mesh mesh_of(const std::string& shape) {
    return parse_mitsuba_xml("<scene version='3.0.0'>" + shape + "</scene>", "s.xml")
        .description.shapes.at(0)
        .mesh;
}

} // namespace

TEST(RoundShapes, AreasAreExact) {
    EXPECT_NEAR(area(make_sphere()), 4 * pi_d, 2e-5);
    EXPECT_NEAR(area(make_disk()), pi_d, 5e-6);
    EXPECT_NEAR(area(make_cylinder()), 2 * pi_d, 1e-5);
}

TEST(RoundShapes, SphereTrianglesLieNearTheSphere) {
    const Mesh mesh = make_sphere();
    double low = 1;
    double high = 1;
    for (const glm::uvec3 t : mesh.triangles)
        for (int i = 0; i <= 8; ++i)
            for (int j = 0; i + j <= 8; ++j) {
                const float a = static_cast<float>(i) / 8;
                const float b = static_cast<float>(j) / 8;
                const auto r = static_cast<double>(glm::length((1 - a - b) * mesh.positions[t.x] +
                                                               a * mesh.positions[t.y] + b * mesh.positions[t.z]));
                low = std::min(low, r);
                high = std::max(high, r);
            }
    EXPECT_GT(low, 1 - 2e-4);
    EXPECT_LT(high, 1 + 2e-4);
}

TEST(RoundShapes, NormalsPointOutwardAndUvsMatchMitsuba) {
    const Mesh sphere = make_sphere();
    for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
        const glm::vec3 n = sphere.normals[i];
        EXPECT_NEAR(glm::length(n), 1, 1e-6);
        EXPECT_NEAR(glm::distance(n, glm::normalize(sphere.positions[i])), 0, 1e-6);
        EXPECT_NEAR(std::acos(std::clamp(n.z, -1.0f, 1.0f)) / pi_d, static_cast<double>(sphere.uvs[i].y), 2e-4);
        if (std::abs(n.z) < 0.999f) {
            const double turns = std::atan2(static_cast<double>(n.y), static_cast<double>(n.x)) / (2 * pi_d);
            const double difference = turns - static_cast<double>(sphere.uvs[i].x);
            EXPECT_NEAR(difference, std::round(difference), 1e-6);
        }
    }
    for (const Mesh& mesh : {sphere, make_cylinder()})
        for (const glm::uvec3 t : mesh.triangles) {
            const glm::vec3 corner = mesh.positions[t.x];
            const glm::vec3 cross = glm::cross(mesh.positions[t.y] - corner, mesh.positions[t.z] - corner);
            EXPECT_GT(glm::dot(cross, mesh.normals[t.x]), 0);
        }
    const Mesh disk = make_disk();
    EXPECT_TRUE(disk.normals.empty());
    for (const glm::uvec3 t : disk.triangles) {
        EXPECT_EQ(front_normal(disk, t), glm::vec3(0, 0, 1));
        EXPECT_EQ(disk.uvs[t.x].x, 0);
        EXPECT_EQ(disk.uvs[t.y].x, 1);
        EXPECT_LT(disk.uvs[t.y].y, disk.uvs[t.z].y);
    }
}

TEST(RoundShapes, ParametersOfASphere) {
    const Mesh mesh = mesh_of("<shape type='sphere'><point name='center' x='1' y='2' z='3'/>"
                              "<float name='radius' value='2'/><boolean name='flip_normals' value='true'/>"
                              "<transform name='to_world'><scale value='3'/></transform></shape>");
    EXPECT_NEAR(area(mesh), 4 * pi_d * 36, 1e-2);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 out = mesh.positions[i] - glm::vec3(3, 6, 9);
        EXPECT_NEAR(glm::length(out), 6, 2e-3);
        EXPECT_NEAR(glm::dot(glm::normalize(out), mesh.normals[i]), -1, 1e-5);
    }
    EXPECT_LT(
        glm::dot(front_normal(mesh, mesh.triangles[5]), mesh.positions[mesh.triangles[5].x] - glm::vec3(3, 6, 9)),
        0);
}

TEST(RoundShapes, ParametersOfACylinder) {
    const Mesh mesh = mesh_of("<shape type='cylinder'><point name='p0' value='1, 0, 0'/><point name='p1' x='4'/>"
                              "<float name='radius' value='0.5'/></shape>");
    EXPECT_NEAR(area(mesh), 2 * pi_d * 0.5 * 3, 1e-4);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 p = mesh.positions[i];
        EXPECT_NEAR(p.x, 1 + 3 * mesh.uvs[i].y, 1e-5);
        EXPECT_NEAR(glm::length(glm::vec2(p.y, p.z)), 0.5, 1e-3);
        EXPECT_NEAR(glm::dot(mesh.normals[i], glm::vec3(0, p.y, p.z)), 0.5, 1e-3);
    }
}

TEST(RoundShapes, MirroredSpherePointsOutward) {
    const Mesh mesh =
        mesh_of("<shape type='sphere'><transform name='to_world'><scale x='-1' y='2'/></transform></shape>");
    for (const glm::uvec3 t : mesh.triangles) {
        EXPECT_GT(glm::dot(front_normal(mesh, t), mesh.positions[t.x]), 0);
        EXPECT_GT(glm::dot(mesh.normals[t.x], mesh.positions[t.x]), 0);
    }
}

TEST(RoundShapes, ReportsTheNumberOfTriangles) {
    const LoadedScene loaded = parse_mitsuba_xml("<scene version='3.0.0'><sensor type='perspective'/>\n"
                                                 "<shape type='disk'/>\n<shape type='sphere'/></scene>",
                                                 "s.xml");
    ASSERT_EQ(loaded.notes.size(), 2u);
    EXPECT_EQ(loaded.notes[0].text, "the disk is approximated by 256 triangles");
    EXPECT_EQ(loaded.notes[1].text, "the sphere is approximated by 36480 triangles");
    EXPECT_EQ(loaded.notes[1].where.line, 3);
}

} // namespace tessera
