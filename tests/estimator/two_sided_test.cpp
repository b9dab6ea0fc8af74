// A two-sided material with another material behind shows each from its side.
#include "render/load/mitsuba_xml.h"
#include "render/paths/tracer.h"
#include "render/scene/scene.h"

#include <string>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

/// Returns the vertex at which a ray from above or below hits a square in the plane z = 0 with this <bsdf>.
Vertex vertex_seen(const Scene& scene, bool from_above) {
    const Ray ray{{0.3f, 0.2f, from_above ? 2.0f : -2.0f}, {0, 0, from_above ? -1.0f : 1.0f}};
    Hit hit;
    EXPECT_TRUE(scene.intersector().closest(ray, hit));
    Vertex v;
    make_vertex(scene, hit, ray, v);
    return v;
}

Scene square_of(const std::string& bsdfs) {
    return Scene(parse_mitsuba_xml("<scene version='3.0.0'><shape type='rectangle'><bsdf type='twosided'>" +
                                       bsdfs + "</bsdf></shape></scene>",
                                   "s.xml")
                     .description);
}

const std::string warm = "<bsdf type='diffuse'><rgb name='reflectance' value='0.7 0.5 0.2'/></bsdf>";
const std::string cold = "<bsdf type='diffuse'><rgb name='reflectance' value='0.1 0.3 0.8'/></bsdf>";

} // namespace

TEST(TwoSided, EachSideHasItsMaterial) {
    const Scene scene = square_of(warm + cold);
    EXPECT_EQ(vertex_seen(scene, true).bsdf.albedo({0, 0, 1}), Rgb(0.7f, 0.5f, 0.2f));
    EXPECT_EQ(vertex_seen(scene, false).bsdf.albedo({0, 0, 1}), Rgb(0.1f, 0.3f, 0.8f));
    EXPECT_GT(vertex_seen(scene, false).to_previous.z, 0);
    EXPECT_EQ(vertex_seen(square_of(warm), false).bsdf.albedo({0, 0, 1}), Rgb(0.7f, 0.5f, 0.2f));
}

TEST(TwoSided, TheBackMayBeAMirror) {
    const Scene scene = square_of(warm + "<bsdf type='conductor'/>");
    EXPECT_FALSE(vertex_seen(scene, true).bsdf.is_mirror());
    EXPECT_TRUE(vertex_seen(scene, false).bsdf.is_mirror());
}

} // namespace tessera
