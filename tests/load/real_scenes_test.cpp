// Complete scenes: those of the shared folder, skipped if it is absent, and those of the assets.

#include "render/load/mitsuba_xml.h"

#include <cmath>
#include <functional>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

/// Returns the file of a shared scene, or an empty path. TESSERA_SHARED_DIR may be the folder `scenes` or its
/// parent.
std::filesystem::path shared_scene(const std::string& name) {
#ifdef TESSERA_SHARED_DIR
    for (const char* between : {"scenes", "."}) {
        const auto file = std::filesystem::path(TESSERA_SHARED_DIR) / between / name / "scene.xml";
        if (std::filesystem::exists(file))
            return file;
    }
#endif
    return {};
}

std::size_t triangle_count(const SceneDescription& scene) {
    std::size_t sum = 0;
    for (const Shape& shape : scene.shapes)
        sum += shape.mesh.triangles.size();
    return sum;
}

const Shape& shape_named(const SceneDescription& scene, const std::string& name) {
    for (const Shape& shape : scene.shapes)
        if (shape.name == name)
            return shape;
    throw std::runtime_error("no shape " + name);
}

template <class Kind>
const Kind& material_of(const SceneDescription& scene, const Shape& shape) {
    return std::get<Kind>(scene.materials.at(static_cast<std::size_t>(shape.material)).kind);
}

void two_threads(int count, const std::function<void(int)>& body) {
    std::thread other([&] {
        for (int i = 1; i < count; i += 2)
            body(i);
    });
    for (int i = 0; i < count; i += 2)
        body(i);
    other.join();
}

std::string all(const std::vector<LoadNote>& notes) {
    std::string result;
    for (const LoadNote& note : notes)
        result += note.where.to_string() + ": " + note.text + "\n";
    return result;
}

void expect_sound(const SceneDescription& scene) {
    for (const Shape& shape : scene.shapes) {
        const Mesh& mesh = shape.mesh;
        ASSERT_LT(static_cast<std::size_t>(shape.material), scene.materials.size());
        ASSERT_LT(shape.area_light, static_cast<int>(scene.area_lights.size()));
        ASSERT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size()) << shape.name;
        ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size()) << shape.name;
        for (glm::uvec3 t : mesh.triangles)
            ASSERT_TRUE(t.x < mesh.positions.size() && t.y < mesh.positions.size() && t.z < mesh.positions.size());
        for (glm::vec3 n : mesh.normals)
            ASSERT_NEAR(glm::length(n), 1, 1e-4);
    }
}

/// Returns the fraction of the area whose front faces away from a point.
double fraction_facing_away(const Mesh& mesh, glm::vec3 point) {
    double away = 0;
    double area = 0;
    for (glm::uvec3 t : mesh.triangles) {
        const glm::vec3 corner = mesh.positions[t.x];
        const glm::vec3 n = glm::cross(mesh.positions[t.y] - corner, mesh.positions[t.z] - corner);
        area += static_cast<double>(glm::length(n));
        away += glm::dot(n, corner - point) > 0 ? static_cast<double>(glm::length(n)) : 0;
    }
    return away / area;
}

} // namespace

TEST(RealScenes, CornellBox) {
    const auto file = shared_scene("cornell-box");
    if (file.empty())
        GTEST_SKIP() << "the shared scenes are missing";
    const LoadedScene loaded = load_mitsuba_xml(file);
    const SceneDescription& scene = loaded.description;
    expect_sound(scene);
    EXPECT_EQ(scene.shapes.size(), 8u);
    EXPECT_EQ(triangle_count(scene), 36u);
    EXPECT_EQ(scene.materials.size(), 8u);
    ASSERT_EQ(scene.area_lights.size(), 1u);
    EXPECT_EQ(scene.area_lights[0].radiance.mean(), Rgb(17, 12, 4));
    EXPECT_EQ(scene.size, glm::ivec2(1024));
    EXPECT_EQ(scene.max_depth, 65);
    EXPECT_FLOAT_EQ(scene.camera.fov, 19.5f);
    EXPECT_EQ(scene.camera.fov_axis, FovAxis::x);
    EXPECT_EQ(glm::vec3(scene.camera.to_world[3]), glm::vec3(0, 1, 6.8f));
    EXPECT_NEAR(scene.camera.to_world[2].z, -1, 1e-6);
    EXPECT_NEAR(scene.camera.to_world[0].x, -1, 1e-6); // +x points left

    for (const Material& material : scene.materials)
        EXPECT_TRUE(material.two_sided) << material.name;
    const auto& left = material_of<DiffuseMaterial>(scene, scene.shapes[4]);
    EXPECT_EQ(left.reflectance.evaluate({{0, 0}}), Rgb(0.63f, 0.065f, 0.05f));

    // Floor and ceiling face into the room, the other walls out of it. Boxes face outward, and the lamp faces
    // down.
    for (std::size_t wall = 0; wall < 5; ++wall)
        EXPECT_EQ(fraction_facing_away(scene.shapes[wall].mesh, {0, 1, 0}), wall < 2 ? 0 : 1) << wall;
    EXPECT_EQ(fraction_facing_away(scene.shapes[5].mesh, {0.328631f, 0.3f, 0.374592f}), 1);
    EXPECT_EQ(fraction_facing_away(scene.shapes[6].mesh, {-0.335439f, 0.6f, -0.291415f}), 1);
    EXPECT_EQ(scene.shapes[7].area_light, 0);
    EXPECT_EQ(fraction_facing_away(scene.shapes[7].mesh, {0, 1, 0}), 0);
    EXPECT_EQ(loaded.notes.size(), 1u) << all(loaded.notes); // max_depth
}

TEST(RealScenes, VeachAjar) {
    const auto file = shared_scene("veach-ajar");
    if (file.empty())
        GTEST_SKIP() << "the shared scenes are missing";
    const LoadedScene loaded = load_mitsuba_xml(file, {}, two_threads);
    const SceneDescription& scene = loaded.description;
    expect_sound(scene);
    EXPECT_EQ(scene.shapes.size(), 22u);
    EXPECT_EQ(triangle_count(scene), 382690u);
    EXPECT_EQ(scene.materials.size(), 13u);
    EXPECT_EQ(scene.area_lights.size(), 1u);
    EXPECT_EQ(scene.size, glm::ivec2(1280, 720));
    EXPECT_EQ(scene.max_depth, 13);
    EXPECT_TRUE(loaded.notes.empty()) << all(loaded.notes);

    const auto& floor = material_of<ConductorMaterial>(scene, shape_named(scene, "Floor"));
    EXPECT_EQ(floor.distribution, MicrofacetDistribution::ggx);
    EXPECT_FLOAT_EQ(floor.alpha.evaluate({}).r, 0.1f);
    EXPECT_FLOAT_EQ(floor.eta.r, 1.65746f);
    EXPECT_FLOAT_EQ(floor.k.b, 4.837f);
    // The checkerboard has 20 x 80 periods, so a square is 1/40 x 1/160.
    EXPECT_EQ(floor.specular_reflectance.evaluate({{0.001f, 0.001f}}), Rgb(0.8f));
    EXPECT_EQ(floor.specular_reflectance.evaluate({{0.001f + 1 / 40.0f, 0.001f}}), Rgb(0.2f));
    EXPECT_EQ(floor.specular_reflectance.evaluate({{0.001f, 0.001f + 1 / 160.0f}}), Rgb(0.2f));

    const auto& handle = material_of<ConductorMaterial>(scene, shape_named(scene, "DoorHandle"));
    EXPECT_EQ(handle.distribution, MicrofacetDistribution::beckmann);
    EXPECT_FLOAT_EQ(material_of<DielectricMaterial>(scene, shape_named(scene, "Material_0001")).eta, 1.5f);

    const auto& door = material_of<DiffuseMaterial>(scene, shape_named(scene, "Door"));
    const auto& bitmap = *std::get<BitmapTexture>(door.reflectance.kind).bitmap;
    EXPECT_GT(bitmap.width, 0);
    EXPECT_EQ(bitmap.bytes.size(),
              3u * static_cast<unsigned>(bitmap.width) * static_cast<unsigned>(bitmap.height));
    EXPECT_TRUE(bitmap.srgb);

    EXPECT_TRUE(shape_named(scene, "Door").mesh.normals.empty());
    EXPECT_FALSE(shape_named(scene, "DoorHandle").mesh.normals.empty());
    EXPECT_FALSE(shape_named(scene, "Pot2_0001").mesh.normals.empty());
    EXPECT_EQ(shape_named(scene, "Pot2_0002").mesh.triangles.size(), 47872u);
}

TEST(RealScenes, NumberOfThreadsDoesNotChangeTheScene) {
    const auto file = shared_scene("veach-ajar");
    if (file.empty())
        GTEST_SKIP() << "the shared scenes are missing";
    const LoadedScene one = load_mitsuba_xml(file);
    const LoadedScene two = load_mitsuba_xml(file, {}, two_threads);
    ASSERT_EQ(one.description.shapes.size(), two.description.shapes.size());
    for (std::size_t i = 0; i < one.description.shapes.size(); ++i) {
        EXPECT_EQ(one.description.shapes[i].mesh.positions, two.description.shapes[i].mesh.positions);
        EXPECT_EQ(one.description.shapes[i].mesh.triangles, two.description.shapes[i].mesh.triangles);
    }
    EXPECT_EQ(all(one.notes), all(two.notes));
}

TEST(RealScenes, CommandLineVariablesOverrideDefaults) {
    const auto file = shared_scene("cornell-box");
    if (file.empty())
        GTEST_SKIP() << "the shared scenes are missing";
    const LoadedScene loaded = load_mitsuba_xml(file, {{"res", "64"}, {"max_depth", "-1"}, {"nosuch", "1"}});
    EXPECT_EQ(loaded.description.size, glm::ivec2(64));
    EXPECT_EQ(loaded.description.max_depth, 65);
    EXPECT_NE(all(loaded.notes).find("'nosuch'"), std::string::npos);
}

TEST(RealScenes, KitchenMasksAndBumps) {
    const auto file = shared_scene("kitchen");
    if (file.empty())
        GTEST_SKIP() << "the shared scenes are missing";
    const LoadedScene loaded = load_mitsuba_xml(file, {}, two_threads);
    expect_sound(loaded.description);
    EXPECT_EQ(all(loaded.notes).find("bsdf"), std::string::npos) << all(loaded.notes);
    const auto named = [&](const std::string& name) -> const Material& {
        for (const Material& m : loaded.description.materials)
            if (m.name == name)
                return m;
        throw std::runtime_error("no material " + name);
    };
    EXPECT_FLOAT_EQ(named("Blinds").opacity.value().evaluate({}).r, 0.612066f);
    // The shapes refer to the material nested in a bumpmap without an id, so they get no bumps, as in Mitsuba.
    EXPECT_FALSE(named("Cushion1").relief);
    const Texture& map = named("bumpmap").relief.value().map;
    EXPECT_FALSE(std::get<BitmapTexture>(map.kind).bitmap->srgb);
}

/// These scenes use plugins that Tessera does not support. They load, and notes report it.
TEST(RealScenes, OtherScenesLoadWithNotes) {
    const std::pair<const char*, std::size_t> expected[] = {
        {"staircase", 775}, {"living-room", 65}, {"classroom", 79}};
    for (const auto& [name, shapes] : expected) {
        const auto file = shared_scene(name);
        if (file.empty())
            GTEST_SKIP() << "the shared scenes are missing";
        const LoadedScene loaded = load_mitsuba_xml(file, {}, two_threads);
        expect_sound(loaded.description);
        EXPECT_EQ(loaded.description.shapes.size(), shapes);
        EXPECT_FALSE(loaded.notes.empty());
    }
}

TEST(RealScenes, CornellBoxOfTheAssets) {
    const auto file = std::filesystem::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml";
    const LoadedScene loaded = load_mitsuba_xml(file);
    const SceneDescription& scene = loaded.description;
    expect_sound(scene);
    EXPECT_EQ(all(loaded.notes), "");
    EXPECT_EQ(scene.size, glm::ivec2(512));
    EXPECT_EQ(scene.max_depth, 8);
    EXPECT_EQ(triangle_count(scene), 36u);
    for (const char* wall : {"floor", "ceiling", "back-wall", "left-wall", "right-wall", "lamp"})
        EXPECT_EQ(fraction_facing_away(shape_named(scene, wall).mesh, {0, 1, 0}), 0) << wall;
    EXPECT_EQ(fraction_facing_away(shape_named(scene, "tall-box").mesh, {-0.36f, 0.62f, -0.34f}), 1);
    EXPECT_EQ(shape_named(scene, "lamp").area_light, 0);
    // All shapes are inside the room.
    for (const Shape& shape : scene.shapes)
        for (glm::vec3 p : shape.mesh.positions)
            EXPECT_TRUE(std::abs(p.x) < 1.001f && std::abs(p.y - 1) < 1.001f && std::abs(p.z) < 1.001f)
                << shape.name;
    EXPECT_FLOAT_EQ(material_of<ConductorMaterial>(scene, shape_named(scene, "tall-box")).alpha.evaluate({}).r,
                    0.12f);
}

} // namespace tessera
