// Normal maps seen from grazing directions and from behind, against values of Mitsuba 3.9.1.
#include "render/load/mitsuba_xml.h"
#include "render/paths/tracer.h"
#include "render/scene/scene.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

glm::vec3 direction(float theta, float phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Returns the XML of a normal map with one normal, (0.6, 0.2, 0.77) of unit length.
std::string normal_map(const std::string& bsdf, const std::string& flags) {
    const glm::vec3 n = 0.5f * glm::normalize(glm::vec3(0.6f, 0.2f, 0.77f)) + 0.5f;
    return "<bsdf type='normalmap'><texture name='normalmap' type='rawconstant'><rgb name='value' value='" +
           std::to_string(n.x) + " " + std::to_string(n.y) + " " + std::to_string(n.z) + "'/></texture>" + flags +
           bsdf + "</bsdf>";
}

std::string two_sided(const std::string& bsdf) {
    return "<bsdf type='twosided'>" + bsdf + "</bsdf>";
}

/// Returns f cos of the red channel at a square for directions from it.
float f_cos(const std::string& bsdf, glm::vec3 to_viewer, glm::vec3 to_light) {
    const Scene scene(
        parse_mitsuba_xml("<scene version='3.0.0'><shape type='rectangle'>" + bsdf + "</shape></scene>", "s.xml")
            .description);
    const Ray ray{glm::vec3(-0.2f, -0.3f, 0) + 0.5f * to_viewer, -to_viewer};
    Hit hit;
    EXPECT_TRUE(scene.intersector().closest(ray, hit));
    Vertex v;
    make_vertex(scene, hit, ray, v);
    return v.evaluate(v.to_local(to_light)).f_cos.r;
}

const std::string diffuse = "<bsdf type='diffuse'><rgb name='reflectance' value='1'/></bsdf>";
const std::string plastic = "<bsdf type='plastic'/>";
const std::string no_flip = "<boolean name='flip_invalid_normals' value='false'/>";
const std::string no_shadow = "<boolean name='use_shadowing_function' value='false'/>";

struct Expected {
    std::string bsdf;
    glm::vec3 to_viewer;
    std::vector<float>
        f_cos; // toward direction(0.3, 1), (1.2, 0.5) and (1.2, 3); mirrored below for a viewer below
};

void expect_values(const std::vector<Expected>& all) {
    for (const Expected& e : all) {
        const float side = e.to_viewer.z < 0 ? -1.0f : 1.0f;
        const glm::vec3 to_lights[] = {direction(0.3f, 1), direction(1.2f, 0.5f), direction(1.2f, 3)};
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec3 to_light = to_lights[i] * glm::vec3(1, 1, side);
            EXPECT_NEAR(f_cos(e.bsdf, e.to_viewer, to_light), e.f_cos[i], 1.5e-4f)
                << e.bsdf << ' ' << e.to_viewer.z << ' ' << i;
        }
    }
}

/// A viewer who sees the bent normal from behind sees it turned about the surface's normal.
TEST(Relief, TurnsInvalidNormalsToTheViewer) {
    const std::string map = normal_map(diffuse, ""), of_plastic = normal_map(plastic, "");
    expect_values({
        {map, direction(0.2f, 0.1f), {0.28091f, 0.24416f, 0}},
        {map, direction(1, pi), {0.18812f, 0, 0.22915f}},
        {map, direction(1.5f, pi), {0.18812f, 0, 0.22915f}},
        {normal_map(diffuse, no_shadow), direction(1.3f, pi), {0.1885f, 0, 0.25758f}},
        {normal_map(diffuse, no_flip), direction(1.3f, pi), {0, 0, 0}},
        {normal_map(diffuse, no_flip + no_shadow), direction(1.3f, 0), {0.28148f, 0.27445f, 0}},
        {of_plastic, direction(0.2f, 0.1f), {0.14252f, 0.1238f, 0}},
        {of_plastic, direction(1.3f, pi), {0.09267f, 0, 0.11557f}},
        {of_plastic, direction(1.3f, 0), {0.14202f, 0.12337f, 0}},
        {of_plastic, direction(1.5f, pi), {0.09157f, 0, 0.1142f}},
    });
}

TEST(Relief, FromBehindDependsOnTheNesting) {
    const glm::vec3 steep = direction(pi - 0.2f, 0.1f), grazing = direction(pi - 1.3f, pi),
                    other = direction(pi - 1.3f, 0);
    const std::string outside = two_sided(normal_map(diffuse, no_shadow)),
                      inside = normal_map(two_sided(diffuse), no_shadow);
    expect_values({
        {outside, steep, {0.2815f, 0.2745f, 0}},
        {outside, grazing, {0.1885f, 0, 0.2576f}},
        {outside, other, {0.2815f, 0.2745f, 0}},
        {inside, steep, {0.1885f, 0, 0.2576f}},
        {inside, grazing, {0.1885f, 0, 0.2576f}},
        {inside, other, {0.2815f, 0.2745f, 0}},
        {two_sided(normal_map(diffuse, no_flip + no_shadow)), grazing, {0, 0, 0}},
        {two_sided(normal_map(diffuse, no_flip + no_shadow)), steep, {0.2815f, 0.2745f, 0}},
    });
}

/// Sampling must draw the directions that evaluate() knows, with their pdf.
TEST(Relief, SamplesOfTurnedNormalsHaveTheirValues) {
    const Scene scene(parse_mitsuba_xml("<scene version='3.0.0'><shape type='rectangle'>" +
                                            normal_map("<bsdf type='roughplastic'/>", "") + "</shape></scene>",
                                        "s.xml")
                          .description);
    const glm::vec3 to_viewer = direction(1.4f, pi);
    const Ray ray{0.5f * to_viewer + glm::vec3(-0.2f, -0.3f, 0), -to_viewer};
    Hit hit;
    ASSERT_TRUE(scene.intersector().closest(ray, hit));
    Vertex v;
    make_vertex(scene, hit, ray, v);
    EXPECT_GE(v.bsdf.albedo(v.to_previous).r, 0.01f);
    double sum = 0, integral = 0;
    constexpr int side = 300;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 u = (glm::vec2(i % side, i / side) + 0.5f) / static_cast<float>(side);
        const glm::vec3 above = sample_cosine_hemisphere(u);
        integral += static_cast<double>(v.evaluate(v.to_local(above)).f_cos.r * pi / above.z);
        const auto s = v.sample(Random(1, static_cast<std::uint32_t>(i), 0).draw(0, Draw::lobe), u);
        if (!s)
            continue;
        EXPECT_GT(v.to_world(s->to_next).z, 0);
        const BsdfValue value = v.evaluate(s->to_next);
        ASSERT_NEAR(value.f_cos.r / s->f_cos.r, 1, 5e-3f);
        ASSERT_NEAR(value.pdf_w / s->pdf_w, 1, 5e-3f);
        sum += static_cast<double>(s->f_cos.r / s->pdf_w);
    }
    EXPECT_NEAR(sum / integral, 1, 0.02);
    EXPECT_GT(sum / (side * side), 0.1);
}

} // namespace

} // namespace tessera
