// Groups of shapes and their instances: intersections, normals, masks, memory and checksums.

#include "render/mesh/meshes.h"
#include "render/paths/tracer.h"
#include "render/sampling/sampling.h"
#include "render/scene/scene_checksums.h"
#include "tests/support/scene_builder.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Returns a rotation with uneven scale, optionally mirrored.
glm::mat4 skewed(bool mirrored) {
    const glm::mat4 moved = glm::translate(glm::mat4(1), glm::vec3(0.3f, -0.2f, 0.1f));
    const glm::mat4 turned = glm::rotate(moved, 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    return glm::scale(turned, glm::vec3(mirrored ? -1.5f : 1.5f, 0.4f, 0.8f));
}

Material bumpy() {
    Material material{"bumpy", DiffuseMaterial{{Rgb(0.5f)}}};
    Texture map;
    map.kind = CheckerboardTexture{Rgb(0), Rgb(1)};
    auto bitmap = std::make_shared<Bitmap>();
    bitmap->width = bitmap->height = 2;
    bitmap->srgb = false;
    bitmap->floats = {Rgb(0.2f), Rgb(0.7f), Rgb(0.9f), Rgb(0.1f)};
    map.kind = BitmapTexture{bitmap, Filter::bilinear, Wrap::repeat};
    material.relief = Relief{Relief::Kind::bump, map, 0.3f};
    return material;
}

/// Two scenes with the same mesh at the same place: as an instance, and as a transformed shape.
struct Twins {
    std::shared_ptr<const Scene> instanced, plain;

    Twins(const Mesh& mesh, const glm::mat4& to_world, bool is_flat) {
        SceneDescription description;
        description.materials.push_back(bumpy());
        SceneDescription copied = description;
        Shape shape;
        shape.mesh = mesh;
        description.groups.push_back({"group", {shape}});
        description.instances.push_back({0, glm::translate(glm::mat4(1), glm::vec3(50, 0, 0))}); // far away
        description.instances.push_back({0, to_world});
        instanced = std::make_shared<const Scene>(std::move(description));
        (is_flat ? void(place_flat_mesh(shape.mesh, {to_world})) : void(place_mesh(shape.mesh, {to_world})));
        copied.shapes.push_back(shape);
        plain = std::make_shared<const Scene>(std::move(copied));
    }
};

/// Returns ray i of random rays from a sphere around the origin toward points near it.
Ray ray(int i) {
    const Random random(7, static_cast<std::uint32_t>(i), 0);
    const glm::vec2 a = random.draw_2d(0, Draw::direction), b = random.draw_2d(1, Draw::direction);
    const glm::vec3 from = 4.0f * glm::normalize(glm::vec3(a - 0.5f, b.x - 0.5f));
    const glm::vec3 to(b.y - 0.5f, a.x - 0.5f, a.y - 0.5f);
    return {from, glm::normalize(to - from)};
}

void expect_twins(const Twins& twins, float tolerance) {
    int hits = 0, agreements = 0;
    for (int i = 0; i < 2000; ++i) {
        Hit one, other;
        const bool met = twins.instanced->intersector().closest(ray(i), one);
        if (met != twins.plain->intersector().closest(ray(i), other))
            continue; // at an edge, rounding decides
        agreements += 1;
        if (!met)
            continue;
        ++hits;
        EXPECT_NE(one.placement, nullptr);
        EXPECT_EQ(other.placement, nullptr);
        EXPECT_EQ(one.shape, 0u) << "shapes of the group come first";
        Vertex a, b;
        make_vertex(*twins.instanced, one, ray(i), a);
        make_vertex(*twins.plain, other, ray(i), b);
        EXPECT_LT(glm::distance(a.position, b.position), 1e-4f);
        EXPECT_LT(glm::distance(a.geometric_normal, b.geometric_normal), 1e-3f) << i;
        EXPECT_LT(glm::distance(a.frame.to_world({0, 0, 1}), b.frame.to_world({0, 0, 1})), tolerance) << i;
        const glm::vec3 beyond = ray(i).origin + (one.distance + 0.01f) * ray(i).direction;
        EXPECT_TRUE(twins.instanced->intersector().occluded({ray(i).origin, beyond}));
        EXPECT_FALSE(twins.instanced->intersector().occluded(
            {ray(i).origin, ray(i).origin + 0.99f * one.distance * ray(i).direction}));
    }
    EXPECT_GT(hits, 300);
    EXPECT_GT(agreements, 1990);
}

TEST(Instances, EqualTransformedMeshes) {
    for (const bool mirrored : {false, true})
        expect_twins(Twins(make_cube(), skewed(mirrored), true), 1e-3f);
}

TEST(Instances, TransformTheirNormals) {
    // The scale is uniform. With an uneven scale, an instance interpolates normals before the transform and a
    // shape after it.
    const glm::mat4 uniform =
        glm::scale(glm::rotate(glm::mat4(1), 0.7f, glm::normalize(glm::vec3(1, 2, 3))), glm::vec3(0.8f));
    expect_twins(Twins(sphere_mesh({0, 0, 0}, 1, 96), uniform, false), 2e-3f);
    const Twins uneven(sphere_mesh({0, 0, 0}, 1, 96), skewed(true), false);
    int outside = 0, hits = 0;
    for (int i = 0; i < 500; ++i) {
        Hit hit;
        if (!uneven.instanced->intersector().closest(ray(i), hit))
            continue;
        ++hits;
        Vertex v;
        make_vertex(*uneven.instanced, hit, ray(i), v);
        outside += glm::dot(v.geometric_normal, ray(i).direction) < 0;
    }
    EXPECT_GT(hits, 50);
    EXPECT_EQ(outside, hits);
}

/// Parallel squares of opacity 0.5: each must decide independently for the same ray.
TEST(Instances, MasksDecideIndependently) {
    constexpr int layers = 4, rays = 20000;
    SceneDescription description;
    Material veil{"veil", DiffuseMaterial{{Rgb(0.5f)}}};
    veil.opacity = Texture{Rgb(0.5f)};
    description.materials.push_back(veil);
    Shape square;
    square.mesh = make_rectangle();
    description.groups.push_back({"veil", {square}});
    for (int i = 0; i < layers; ++i)
        description.instances.push_back({0, glm::translate(glm::mat4(1), glm::vec3(0, 0, 0.25f * float(i)))});
    const Scene scene(std::move(description));
    int open = 0, met = 0;
    for (int i = 0; i < rays; ++i) {
        const glm::vec2 at =
            1.8f * (Random(3, static_cast<std::uint32_t>(i), 0).draw_2d(0, Draw::direction) - 0.5f);
        Hit hit;
        open += !scene.intersector().occluded({{at, 2}, {at, -2}});
        met += scene.intersector().closest({{at, 2}, {0, 0, -1}}, hit);
    }
    const double expected = rays * std::pow(0.5, layers), deviation = std::sqrt(expected);
    EXPECT_NEAR(open, expected, 4 * deviation);
    EXPECT_NEAR(rays - met, expected, 4 * deviation);
}

TEST(Instances, TakeLittleMemory) {
    constexpr int edge = 224, count = 10'000; // 100352 triangles
    Shape grid;
    for (int y = 0; y <= edge; ++y)
        for (int x = 0; x <= edge; ++x)
            grid.mesh.positions.emplace_back(x, y, std::sin(float(x * y)));
    for (unsigned y = 0; y < edge; ++y)
        for (unsigned x = 0; x < edge; ++x) {
            const unsigned a = y * (edge + 1) + x;
            grid.mesh.triangles.push_back({a, a + 1, a + edge + 1});
            grid.mesh.triangles.push_back({a + 1, a + edge + 2, a + edge + 1});
        }
    SceneDescription description;
    description.materials.push_back(bumpy());
    description.groups.push_back({"grid", {grid}});
    for (int i = 0; i < count; ++i)
        description.instances.push_back(
            {0, glm::translate(glm::mat4(1), glm::vec3(300 * (i % 100), 300 * (i / 100), 0))});
    const Scene scene(std::move(description));
    EXPECT_EQ(scene.triangle_count(), 100352u);
    const std::size_t bytes = scene.intersector().bytes();
    RecordProperty("bytes", static_cast<int>(bytes));
    EXPECT_LT(bytes, 30'000'000u) << "10^9 triangles without instances would take 70 GB";
    Hit hit;
    ASSERT_TRUE(scene.intersector().closest({{300 * 57 + 100.3f, 300 * 83 + 100.4f, 50}, {0, 0, -1}}, hit));
    EXPECT_NEAR(hit.distance, 50, 1.1f);
}

TEST(Instances, CountInChecksumsAndTraits) {
    const auto sums = [](const glm::mat4& to_world, int groups) {
        SceneDescription d = Twins(make_cube(), skewed(false), true).instanced->description();
        d.instances[1].to_world = to_world;
        for (int i = 1; i < groups; ++i)
            d.groups.push_back(d.groups.front());
        EXPECT_EQ(traits_of(d).instances, 2);
        EXPECT_EQ(traits_of(d).relief, 1);
        return checksums_of(d, d.camera);
    };
    EXPECT_EQ(sums(skewed(false), 1), sums(skewed(false), 1));
    EXPECT_EQ(difference(sums(skewed(false), 1), sums(skewed(true), 1)), "geometry");
    EXPECT_NE(sums(skewed(false), 1).geometry, sums(skewed(false), 2).geometry);
}

} // namespace

} // namespace tessera::test
