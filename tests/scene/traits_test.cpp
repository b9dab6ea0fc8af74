// Traits of scenes, such as delta lobes, masks and textures.
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"

#include <utility>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

Texture alpha_map(float min, float max) {
    auto bitmap = std::make_shared<Bitmap>();
    bitmap->width = 2;
    bitmap->height = 1;
    bitmap->srgb = false;
    bitmap->floats = {Rgb(max), Rgb(min)};
    Texture texture;
    texture.kind = BitmapTexture{bitmap, Filter::bilinear, Wrap::repeat};
    return texture;
}

/// Returns the traits of a square with this material.
SceneTraits traits_of_material(const Material& material) {
    SceneBuilder b;
    b.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, b.material(material));
    return traits_of(b.build()->description());
}

Material conductor(Texture alpha) {
    ConductorMaterial kind;
    kind.alpha = std::move(alpha);
    return {"", kind};
}

TEST(SceneTraits, DiffuseBoxHasItsLampOnly) {
    SceneBuilder b;
    const int white = b.diffuse(Rgb(0.7f));
    b.room({white, white, white, white, white});
    b.quad({0, 0.9f, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}, white, b.light(Rgb(1)));
    SceneTraits expected;
    expected.area_lights = 1;
    EXPECT_EQ(traits_of(b.build()->description()), expected);
    EXPECT_EQ(traits_of(SceneDescription()), SceneTraits());
}

TEST(SceneTraits, UnusedMaterialsDoNotCount) {
    SceneBuilder b;
    b.glass();
    b.mirror();
    b.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, b.diffuse(Rgb(0.5f)));
    EXPECT_EQ(traits_of(b.build()->description()), SceneTraits());
}

TEST(SceneTraits, LobesOfEveryKindOfMaterial) {
    SceneBuilder b;
    const auto shape_of = [&](int material) { b.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, material); };
    shape_of(b.mirror());                  // delta
    shape_of(b.glass());                   // delta, transmission
    shape_of(b.glass(1.5f, true));         // delta, transmission
    shape_of(b.conductor(0.05f));          // glossy
    shape_of(b.conductor(0.3f));           // neither
    shape_of(b.plastic(Rgb(0.5f), 0));     // delta
    shape_of(b.plastic(Rgb(0.5f), 0.05f)); // glossy
    shape_of(b.plastic(Rgb(0.5f), 0.2f));  // neither
    const SceneTraits traits = traits_of(b.build()->description());
    EXPECT_EQ(traits.delta_lobes, 4);
    EXPECT_EQ(traits.glossy_lobes, 2);
    EXPECT_EQ(traits.transmission, 2);
    EXPECT_EQ(traits.textures, 0);
}

TEST(SceneTraits, LobesOfPrincipledAndTranslucentMaterials) {
    const auto expect = [](const Material& material, int delta, int glossy, int transmission) {
        const SceneTraits traits = traits_of_material(material);
        EXPECT_EQ(traits.delta_lobes, delta);
        EXPECT_EQ(traits.glossy_lobes, glossy);
        EXPECT_EQ(traits.transmission, transmission);
    };
    PrincipledMaterial principled;
    expect({"", principled}, 0, 0, 0);
    principled.roughness = Texture(Rgb(0.2f));
    principled.spec_trans = Texture(Rgb(0.5f));
    expect({"", principled}, 0, 1, 1);
    ThinPrincipledMaterial sheet;
    expect({"", sheet}, 0, 0, 0);
    sheet.diff_trans = Texture(Rgb(1));
    expect({"", sheet}, 0, 0, 1);
    expect({"", WardMaterial{}}, 0, 0, 0);
    expect({"", DiffuseTransmitterMaterial{}}, 0, 0, 1);
    expect({"", MediumLayerMaterial{}}, 1, 0, 1);
    // Roughness along one axis is enough: no delta lobe.
    ConductorMaterial brushed;
    brushed.alpha_v = Texture(Rgb(0.5f));
    expect({"", brushed}, 0, 1, 0);
}

TEST(SceneTraits, TexturedRoughnessCountsByItsMinimum) {
    const auto expect = [](Texture alpha, int delta, int glossy) {
        const SceneTraits traits = traits_of_material(conductor(std::move(alpha)));
        EXPECT_EQ(traits.delta_lobes, delta);
        EXPECT_EQ(traits.glossy_lobes, glossy);
        EXPECT_EQ(traits.textures, 1);
    };
    expect(alpha_map(0.2f, 0.4f), 0, 0);
    expect(alpha_map(0.05f, 0.4f), 0, 1);
    expect(alpha_map(0, 0.4f), 1, 1);
    Texture scaled = alpha_map(0.2f, 0.4f);
    scaled.scale = 0.25f;
    expect(scaled, 0, 1);
    Texture checkerboard;
    checkerboard.kind = CheckerboardTexture{Rgb(0.4f), Rgb(0.05f)};
    expect(checkerboard, 0, 1);
}

TEST(SceneTraits, MasksAndRelief) {
    Material m{"", DiffuseMaterial{}};
    m.opacity = Rgb(1);
    EXPECT_EQ(traits_of_material(m).masks, 0);
    m.opacity = Rgb(0.5f);
    EXPECT_EQ(traits_of_material(m).masks, 1);
    m.opacity = alpha_map(0, 1);
    EXPECT_EQ(traits_of_material(m).masks, 1);
    EXPECT_EQ(traits_of_material(m).textures, 1);
    EXPECT_EQ(traits_of_material(m).relief, 0);
    m.relief = Relief{Relief::Kind::bump, alpha_map(0, 1), 1};
    EXPECT_EQ(traits_of_material(m).relief, 1);
}

TEST(SceneTraits, AttributesAndShadingNormals) {
    Texture colors;
    colors.kind = AttributeTexture{"vertex_color"};
    SceneBuilder b;
    b.sphere({0, 0, 0}, 1, b.material({"", DiffuseMaterial{colors}}));
    const SceneTraits traits = traits_of(b.build()->description());
    EXPECT_EQ(traits.mesh_attributes, 1);
    EXPECT_EQ(traits.shading_normals, 1);
}

} // namespace

} // namespace tessera::test
