// Checksums of a reference's scene: they cover all that changes the picture, and nothing else.
#include "render/scene/scene_checksums.h"
#include "tests/support/scene_builder.h"

#include <functional>
#include <utility>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

Texture picture() {
    auto bitmap = std::make_shared<Bitmap>();
    bitmap->width = 64;
    bitmap->height = 64;
    bitmap->bytes.assign(3 * 64 * 64, 100);
    Texture texture;
    texture.kind = BitmapTexture{bitmap, Filter::bilinear, Wrap::repeat};
    return texture;
}

/// Returns a room with textures, materials and lights of many kinds.
SceneDescription room() {
    SceneBuilder b;
    const int diffuse = b.diffuse(Rgb(0.7f)), mirror = b.conductor(0.2f), plastic = b.plastic(Rgb(0.3f), 0.1f);
    const int textured = b.material({"textured", DiffuseMaterial{picture()}});
    b.room({textured, diffuse, b.blend(diffuse, mirror, 0.3f), b.coated(diffuse, Rgb(0.1f)), plastic});
    b.quad({0, 0.9f, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}, diffuse, b.light(Rgb(1)));
    b.sphere({0, 0, 0}, 0.3f, b.glass());
    b.point({{0, 0.5f, 0}, Rgb(1)});
    b.directional({{0, 1, 0}, Rgb(0.1f)});
    b.environment({Rgb(1), Rgb(2)}, 2);
    b.sun({});
    b.camera({0, 0, 4}, {0, 0, 0}, 40);
    return b.build()->description();
}

SceneChecksums sums(const SceneDescription& scene) {
    return checksums_of(scene, scene.camera);
}

/// Returns the parts of the checksums that differ after a change of the room, in words.
std::string difference_after(const std::function<void(SceneDescription&)>& change) {
    static const SceneDescription before = room();
    SceneDescription scene = before;
    change(scene);
    return difference(sums(before), sums(scene));
}

/// Returns a bitmap texture with one byte changed.
Texture with_other_byte(const Texture& texture) {
    Texture other = texture;
    auto& kind = std::get<BitmapTexture>(other.kind);
    auto bitmap = std::make_shared<Bitmap>(*kind.bitmap);
    ++bitmap->bytes[5000];
    kind.bitmap = bitmap;
    return other;
}

TEST(SceneChecksums, CoverAllThatAPictureShows) {
    using S = SceneDescription;
    EXPECT_EQ(difference_after([](S& s) { s.shapes.back().mesh.positions[40].x += 1e-6f; }), "geometry");
    EXPECT_EQ(difference_after([](S& s) { s.shapes.back().mesh.normals.clear(); }), "geometry");
    EXPECT_EQ(difference_after(
                  [](S& s) { std::swap(s.shapes[0].mesh.triangles[0].x, s.shapes[0].mesh.triangles[0].y); }),
              "geometry");
    EXPECT_EQ(difference_after([](S& s) { s.shapes[0].material = s.shapes[1].material; }), "materials");
    EXPECT_EQ(difference_after([](S& s) { s.materials[0].two_sided = !s.materials[0].two_sided; }), "materials")
        << "the material of the ceiling";
    EXPECT_EQ(difference_after([](S& s) { s.materials[0].back = std::make_shared<const Material>(); }),
              "materials");
    EXPECT_EQ(difference_after([](S& s) {
                  Material& wall = s.materials[static_cast<std::size_t>(s.shapes[0].material)];
                  auto& kind = std::get<DiffuseMaterial>(wall.kind);
                  kind.reflectance = with_other_byte(kind.reflectance);
              }),
              "materials");
    EXPECT_EQ(difference_after([](S& s) {
                  Material& wall = s.materials[static_cast<std::size_t>(s.shapes[2].material)];
                  std::get<MixtureMaterial>(wall.kind).blend_weight = Texture(Rgb(0.31f));
              }),
              "materials");
    EXPECT_EQ(difference_after([](S& s) {
                  Material& wall = s.materials[static_cast<std::size_t>(s.shapes[4].material)];
                  std::get<PlasticMaterial>(wall.kind).scatters_once = true;
              }),
              "materials");
    EXPECT_EQ(difference_after(
                  [](S& s) { s.materials[static_cast<std::size_t>(s.shapes[0].material)].relief.emplace(); }),
              "materials");
    EXPECT_EQ(difference_after([](S& s) { s.area_lights[0].radiance = Texture(Rgb(1.001f)); }), "lights");
    EXPECT_EQ(difference_after([](S& s) { s.shapes[5].area_light = -1; }), "lights");
    EXPECT_EQ(difference_after([](S& s) { s.point_lights[0].cutoff = 170; }), "lights");
    EXPECT_EQ(difference_after([](S& s) { s.directional_lights.clear(); }), "lights");
    EXPECT_EQ(difference_after([](S& s) { s.environment.map->scale = 2; }), "lights");
    EXPECT_EQ(difference_after([](S& s) { s.environment.sun->radius *= 2; }), "lights");
    EXPECT_EQ(difference_after([](S& s) { s.camera.fov_axis = FovAxis::y; }), "camera");
    EXPECT_EQ(difference_after([](S& s) { s.camera.to_world[3].x += 1e-5f; }), "camera");
    EXPECT_EQ(difference_after([](S& s) {
                  s.camera.fov = 1;
                  s.point_lights.clear();
              }),
              "lights and camera");
    EXPECT_EQ(difference_after([](S& s) { s = {}; }), "geometry, materials, lights and camera");
}

TEST(SceneChecksums, IgnoreWhatNoPictureShows) {
    using S = SceneDescription;
    EXPECT_EQ(difference_after([](S&) {}), "");
    EXPECT_EQ(sums(room()), sums(room())) << "independent of addresses in memory";
    EXPECT_EQ(difference_after([](S& s) {
                  for (Shape& shape : s.shapes)
                      shape.name += "'";
                  for (Material& material : s.materials)
                      material.name += "'";
              }),
              "");
    EXPECT_EQ(difference_after([](S& s) {
                  s.materials.insert(s.materials.begin(), Material{"unused", DiffuseMaterial{}});
                  for (Shape& shape : s.shapes)
                      ++shape.material;
              }),
              "");
    EXPECT_EQ(difference_after([](S& s) {
                  s.size = {7, 7};
                  s.max_depth = 3;
              }),
              "")
        << "size and depth belong to the picture, not to the scene";
}

TEST(SceneChecksums, ConvertToTextAndBack) {
    const SceneChecksums known{0x1234, 0xffffffff, 0, 7};
    EXPECT_EQ(to_string(known), "geometry 00001234 materials ffffffff lights 00000000 camera 00000007");
    EXPECT_EQ(scene_checksums_from(to_string(known)), known);
    EXPECT_FALSE(scene_checksums_from(""));
    EXPECT_FALSE(scene_checksums_from("geometry 1 materials 2"));
}

} // namespace

} // namespace tessera::test
