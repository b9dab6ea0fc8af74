// Shading frames: their tangents follow the texture's u where roughness is anisotropic, seen from either side.
#include "render/paths/tracer.h"
#include "tests/support/scene_builder.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Returns the vertex at which a ray from above or below hits the square.
Vertex vertex_seen(const Scene& scene, bool from_above) {
    const Ray ray{{0.3f, 0.2f, from_above ? 2.0f : -2.0f}, {0, 0, from_above ? -1.0f : 1.0f}};
    Hit hit;
    EXPECT_TRUE(scene.intersector().closest(ray, hit));
    Vertex v;
    make_vertex(scene, hit, ray, v);
    return v;
}

TEST(ShadingFrame, FollowsUOfAnisotropicSurfaces) {
    const glm::vec3 along_u = glm::normalize(glm::vec3(1, 0.5f, 0));
    for (const bool is_brushed : {false, true}) {
        SceneBuilder b;
        b.quad({-1, -1, 0}, {2, 1, 0}, {-1, 2, 0}, is_brushed ? b.brushed(0.1f, 0.4f) : b.conductor(0.2f));
        const auto scene = b.build();
        for (const bool from_above : {false, true}) {
            const Vertex v = vertex_seen(*scene, from_above);
            EXPECT_NEAR(v.frame.normal.z, from_above ? 1 : -1, 1e-6f);
            EXPECT_EQ(std::abs(glm::dot(v.frame.tangent, along_u)) > 0.9999f, is_brushed);
            const glm::vec3 third = glm::cross(v.frame.tangent, v.frame.bitangent);
            EXPECT_LT(glm::distance(third, v.frame.normal), 1e-5f);
        }
    }
}

/// As in Mitsuba, `twosided` around a relief mirrors it in the surface: tangential slopes are equal from both
/// sides. A relief around `twosided` is seen from inside.
TEST(ShadingFrame, ReliefFromBehindDependsOnTheNesting) {
    const glm::vec3 bent = glm::normalize(glm::vec3(0.3f, -0.2f, 1));
    Relief relief;
    relief.kind = Relief::Kind::normal_map;
    relief.map = Texture(0.5f * bent + 0.5f);
    for (const bool is_mirrored : {false, true}) {
        relief.is_mirrored_behind = is_mirrored;
        Material m{"relief", DiffuseMaterial{{Rgb(0.5f)}}, true};
        m.relief = relief;
        SceneBuilder b;
        b.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, b.material(m));
        const auto scene = b.build();
        EXPECT_LT(glm::distance(vertex_seen(*scene, true).frame.normal, bent), 1e-5f);
        const glm::vec3 behind = is_mirrored ? glm::vec3(bent.x, bent.y, -bent.z) : -bent;
        EXPECT_LT(glm::distance(vertex_seen(*scene, false).frame.normal, behind), 1e-5f);
    }
}

TEST(ShadingFrame, IsOrthonormalWithoutAUsableU) {
    const glm::vec3 normal = glm::normalize(glm::vec3(0.2f, 0.3f, 1));
    for (const glm::vec3 along : {normal, glm::vec3(0), glm::vec3(NAN)}) {
        const Frame frame(normal, along);
        EXPECT_NEAR(glm::length(frame.tangent), 1, 1e-5f);
        EXPECT_NEAR(glm::dot(frame.tangent, normal), 0, 1e-5f);
    }
}

} // namespace

} // namespace tessera::test
