// Spheres, disks and cylinders in scene files. tests/surface/quadric_test.cpp has their geometry.

#include "render/load/mitsuba_xml.h"

#include <cmath>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

constexpr double pi_d = std::numbers::pi;

Quadric quadric_of(const std::string& shape) {
    const LoadedScene loaded = parse_mitsuba_xml("<scene version='3.0.0'>" + shape + "</scene>", "s.xml");
    EXPECT_TRUE(loaded.description.shapes.at(0).mesh.triangles.empty());
    return loaded.description.shapes.at(0).quadric.value();
}

TEST(RoundShapes, ParametersOfASphere) {
    const Quadric sphere = quadric_of("<shape type='sphere'><point name='center' x='1' y='2' z='3'/>"
                                      "<float name='radius' value='2'/><boolean name='flip_normals' value='true'/>"
                                      "<transform name='to_world'><scale value='3'/></transform></shape>");
    EXPECT_NEAR(sphere.area(), 4 * pi_d * 36, 1e-3);
    EXPECT_NEAR(sphere.radius(), 6, 1e-5);
    for (const glm::vec3 local : {glm::vec3(1, 0, 0), glm::vec3(0, -0.6f, 0.8f)}) {
        const glm::vec3 out = sphere.position(local) - glm::vec3(3, 6, 9);
        EXPECT_NEAR(glm::length(out), 6, 1e-5);
        EXPECT_LT(glm::distance(sphere.normal(local), -out / 6.0f), 1e-5f);
    }
}

TEST(RoundShapes, ParametersOfACylinder) {
    const Quadric tube =
        quadric_of("<shape type='cylinder'><point name='p0' value='1, 0, 0'/><point name='p1' x='4'/>"
                   "<float name='radius' value='0.5'/></shape>");
    EXPECT_NEAR(tube.area(), 2 * pi_d * 0.5 * 3, 1e-4);
    for (const glm::vec3 local : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 1), glm::vec3(0.6f, 0.8f, 0.25f)}) {
        const glm::vec3 p = tube.position(local);
        EXPECT_NEAR(p.x, 1 + 3 * tube.uv(local).y, 1e-5);
        EXPECT_NEAR(glm::length(glm::vec2(p.y, p.z)), 0.5, 1e-5);
        EXPECT_NEAR(glm::dot(tube.normal(local), glm::vec3(0, p.y, p.z)), 0.5, 1e-5);
    }
}

/// As in Mitsuba 3, mirroring turns a sphere inside out, but neither a cylinder nor a disk mirrored in its plane.
TEST(RoundShapes, MirroringTurnsSpheres) {
    const std::string mirrored = "<transform name='to_world'><scale x='-1'/></transform></shape>";
    EXPECT_TRUE(quadric_of("<shape type='sphere'>" + mirrored).has_front_inside());
    EXPECT_FALSE(quadric_of("<shape type='sphere'><boolean name='flip_normals' value='true'/>" + mirrored)
                     .has_front_inside());
    EXPECT_FALSE(quadric_of("<shape type='cylinder'>" + mirrored).has_front_inside());
    EXPECT_EQ(quadric_of("<shape type='disk'>" + mirrored).normal({0, 0, 0}), glm::vec3(0, 0, 1));
}

TEST(RoundShapes, HaveNoNotes) {
    const LoadedScene loaded = parse_mitsuba_xml("<scene version='3.0.0'><sensor type='perspective'/>\n"
                                                 "<shape type='disk'/>\n<shape type='sphere'/></scene>",
                                                 "s.xml");
    EXPECT_TRUE(loaded.notes.empty());
}

} // namespace

} // namespace tessera
