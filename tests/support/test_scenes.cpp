// Small scenes for tests of estimators.
#include "tests/support/rooms.h"

#include <memory>
#include <utility>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace tessera::test {

namespace {

std::shared_ptr<const Scene> diffuse_room() {
    return Room().build();
}

std::shared_ptr<const Scene> room_with_floor(int (*make)(SceneBuilder&)) {
    Room r;
    const int m = make(r);
    r.quad({-0.95f, -0.97f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, m);
    r.sphere({0.35f, -0.55f, 0}, 0.35f, m);
    return r.build();
}

std::shared_ptr<const Scene> glossy() {
    return room_with_floor([](SceneBuilder& b) { return b.conductor(0.1f); });
}
std::shared_ptr<const Scene> beckmann() {
    return room_with_floor([](SceneBuilder& b) { return b.conductor(0.3f, MicrofacetDistribution::beckmann); });
}
std::shared_ptr<const Scene> brushed() {
    return room_with_floor([](SceneBuilder& b) { return b.brushed(0.08f, 0.4f); });
}
std::shared_ptr<const Scene> nearly_mirror() {
    return room_with_floor([](SceneBuilder& b) { return b.conductor(0.02f); });
}
std::shared_ptr<const Scene> plastic() {
    return room_with_floor([](SceneBuilder& b) { return b.plastic(Rgb(0.2f, 0.5f, 0.7f), 0); });
}
std::shared_ptr<const Scene> rough_plastic() {
    return room_with_floor([](SceneBuilder& b) { return b.plastic(Rgb(0.2f, 0.5f, 0.7f), 0.1f); });
}
std::shared_ptr<const Scene> mirror_floor() {
    return room_with_floor([](SceneBuilder& b) { return b.mirror(); });
}
std::shared_ptr<const Scene> glass_ball() {
    Room r;
    r.sphere({-0.1f, -0.3f, 0.1f}, 0.6f, r.glass());
    return r.build();
}

/// A pane of glass across half of the view, and a highly reflective pane on the wall.
std::shared_ptr<const Scene> thin_panes() {
    Room r;
    r.quad({-0.9f, -0.9f, 0.4f}, {0.9f, 0, 0.2f}, {0, 1.6f, 0}, r.glass(1.5f, true));
    r.quad({0.2f, -0.7f, -0.9f}, {0.7f, 0, 0.1f}, {0, 1.2f, 0}, r.glass(3.0f, true));
    return r.build();
}

/// Slats between the visible points of neighbouring pixels and the rest of the room, which block new edges.
std::shared_ptr<const Scene> blinds() {
    Room r;
    for (int i = 0; i < 7; ++i)
        r.quad({-0.9f, -0.8f + 0.25f * static_cast<float>(i), 0.3f}, {1.8f, 0, 0}, {0, 0.1f, 0.05f}, r.w);
    return r.build();
}

std::shared_ptr<const Scene> texture_edges() {
    Room r;
    DiffuseMaterial checker;
    checker.reflectance.kind = CheckerboardTexture{Rgb(0.9f, 0.1f, 0), Rgb(0, 0.2f, 0.8f)};
    checker.reflectance.to_uv = glm::mat3(7.0f);
    const int m = r.material({"checker", checker, true});
    r.quad({-0.98f, -0.9f, -0.9f}, {1.96f, 0, 0}, {0, 1.8f, 0}, m);
    return r.build();
}

/// A wall and a ball with black and coloured texels smaller than a pixel.
std::shared_ptr<const Scene> black_texels() {
    Room r;
    DiffuseMaterial checker;
    checker.reflectance.kind = CheckerboardTexture{Rgb(0), Rgb(0.9f, 0.6f, 0.05f)};
    checker.reflectance.to_uv = glm::mat3(13.0f);
    const int m = r.material({"checker", checker, true});
    r.quad({-0.98f, -0.9f, -0.9f}, {1.96f, 0, 0}, {0, 1.8f, 0}, m);
    r.sphere({0.3f, -0.3f, 0}, 0.4f, m);
    return r.build();
}

std::shared_ptr<const Scene> grazing() {
    Room r;
    r.quad({-0.95f, -0.97f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, r.conductor(0.2f));
    r.camera({0, -0.9f, 2.4f}, {0, -0.97f, 0}, 40);
    return r.build();
}

/// Mirror, glass, glossy and diffuse side by side within every tile.
std::shared_ptr<const Scene> patchwork() {
    Room r;
    const int materials[] = {r.mirror(), r.conductor(0.05f), r.w, r.glass(), r.conductor(0.3f), r.r};
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            r.quad({-0.9f + 0.3f * static_cast<float>(i), -0.9f + 0.3f * static_cast<float>(j), -0.2f},
                   {0.28f, 0, 0}, {0, 0.28f, 0}, materials[(i + 2 * j) % 6]);
    return r.build();
}

/// A lamp that also reflects light and has a dark back, and a one-sided wall that is black from behind.
std::shared_ptr<const Scene> shining_wall() {
    Room r;
    r.quad({-0.5f, -0.6f, -0.3f}, {0.8f, 0, -0.3f}, {0, 0.9f, 0}, r.w, r.lamp);
    const int one_sided = r.material({"one-sided", DiffuseMaterial{{white}}, false});
    r.quad({0.5f, -0.5f, 0.2f}, {-0.3f, 0, 0}, {0, 0.7f, 0}, one_sided);
    return r.build();
}

/// Diffuse walls that see a lamp through a panel that is too glossy to be connectable. Posts hide the panel from
/// some pixels and not from their neighbours.
std::shared_ptr<const Scene> glossy_second_vertex() {
    SceneBuilder b;
    const int w = b.diffuse(white), black = b.diffuse(Rgb(0));
    const int panel = b.conductor(0.08f);
    b.room({w, w, w, w, panel});
    b.quad({-0.3f, 0.9f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}, black, b.light(Rgb(30, 25, 20)));
    for (int i = 0; i < 6; ++i)
        b.quad({0.55f, -0.95f, -0.9f + 0.3f * static_cast<float>(i)}, {0, 1.6f, 0}, {0, 0, 0.12f}, w);
    b.camera({0, 0, 2.6f}, {-0.3f, 0, 0}, 50);
    return b.build();
}

/// All lobes of the principled BSDFs: a floor with clear coat, a ball of frosted glass and a thin sheet.
std::shared_ptr<const Scene> principled(float metallic, float spec_trans, float sheet_spec_trans) {
    Room r;
    PrincipledMaterial floor;
    floor.base_color = Texture(Rgb(0.7f, 0.5f, 0.2f));
    floor.roughness = Texture(Rgb(0.4f));
    floor.anisotropic = Texture(Rgb(0.7f));
    floor.metallic = Texture(Rgb(metallic));
    floor.sheen = floor.sheen_tint = floor.flatness = floor.spec_tint = Texture(Rgb(0.5f));
    floor.clearcoat = Texture(Rgb(1));
    r.quad({-0.95f, -0.97f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, r.material({"floor", floor, true}));
    PrincipledMaterial ball;
    ball.base_color = Texture(Rgb(0.6f, 0.8f, 0.9f));
    ball.spec_trans = Texture(Rgb(spec_trans));
    r.sphere({-0.4f, -0.5f, 0}, 0.4f, r.material({"ball", ball, false}));
    ThinPrincipledMaterial sheet;
    sheet.base_color = Texture(Rgb(0.8f, 0.7f, 0.5f));
    sheet.spec_trans = Texture(Rgb(sheet_spec_trans));
    sheet.diff_trans = Texture(Rgb(0.9f));
    r.quad({0, -0.9f, 0.3f}, {0.8f, 0, 0.2f}, {0, 1.4f, 0}, r.material({"sheet", sheet, false}));
    return r.build();
}

std::shared_ptr<const Scene> ward() {
    return room_with_floor([](SceneBuilder& b) {
        WardMaterial m;
        m.alpha_v = Texture(Rgb(0.3f));
        m.diffuse_reflectance = Texture(Rgb(0));
        m.specular_reflectance = Texture(Rgb(0.8f, 0.7f, 0.6f));
        return b.material({"ward", m, true});
    });
}

/// A lampshade, and a transparent layer that scatters light forward.
std::shared_ptr<const Scene> translucent() {
    Room r;
    r.sphere({-0.4f, 0.3f, 0}, 0.4f, r.material({"shade", DiffuseTransmitterMaterial{{Rgb(0.8f, 0.6f, 0.4f)}}}));
    MediumLayerMaterial layer;
    layer.scattered = Texture(Rgb(0.9f, 0.6f, 0.3f));
    layer.lost = Texture(Rgb(0.1f));
    layer.g = 0.6f;
    r.quad({0, -0.9f, 0.3f}, {0.8f, 0, 0.2f}, {0, 1.4f, 0}, r.material({"layer", layer}));
    return r.build();
}

/// Two balls of rough glass with different indices.
std::shared_ptr<const Scene> rough_glass() {
    Room r;
    r.sphere({-0.3f, -0.4f, 0}, 0.5f, r.rough_glass(0.3f));
    r.sphere({0.5f, -0.5f, 0.2f}, 0.4f, r.rough_glass(0.2f, 1.33f));
    return r.build();
}

/// Blends of diffuse, reflecting and refracting materials, smooth and rough.
std::shared_ptr<const Scene> blends() {
    Room r;
    const int floor = r.blend(r.diffuse(green), r.mirror(), 0.4f);
    r.quad({-0.95f, -0.97f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, floor);
    r.sphere({-0.4f, -0.5f, 0}, 0.4f, r.blend(r.rough_glass(0.3f), r.conductor(0.2f), 0.3f));
    r.sphere({0.4f, -0.5f, 0.1f}, 0.35f, r.blend(r.glass(), r.conductor(0.3f), 0.4f));
    return r.build();
}

std::shared_ptr<const Scene> coated() {
    Room r;
    r.quad({-0.95f, -0.97f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f},
           r.coated(r.conductor(0.2f), Rgb(0.2f, 0.4f, 0.1f)));
    r.sphere({-0.4f, -0.5f, 0}, 0.4f, r.coated(r.mirror(), Rgb(0.3f, 0.1f, 0.1f)));
    r.sphere({0.4f, -0.5f, 0.1f}, 0.35f, r.coated(r.rough_diffuse(red, 0.5f), Rgb(0)));
    return r.build();
}

/// A chequered floor of glass, which has delta scatters only, and of smooth plastic, which is connectable. Short
/// and long edges lead to both.
std::shared_ptr<const Scene> glass_in_plastic() {
    Room r;
    const int glass = r.glass(3, true), plastic = r.plastic(Rgb(0.2f, 0.5f, 0.7f), 0);
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j)
            r.quad({-0.96f + 0.16f * static_cast<float>(i), -0.97f, 0.96f - 0.16f * static_cast<float>(j)},
                   {0.16f, 0, 0}, {0, 0, -0.16f}, (i + j) % 2 ? glass : plastic);
    return r.build();
}

/// A lamp behind the camera, seen in a wall of mirrors, smooth plastic and glass. It is directly visible emission
/// in mirrors, and ordinary light paths in the pixels beside them.
std::shared_ptr<const Scene> lamp_in_mirrors() {
    Room r;
    const int kinds[] = {r.mirror(), r.plastic(Rgb(0.2f, 0.5f, 0.7f), 0), r.mirror(), r.glass(1.5f, true)};
    for (int i = 0; i < 4; ++i)
        r.quad({-0.96f + 0.48f * static_cast<float>(i), -0.9f, -0.9f}, {0.48f, 0, 0}, {0, 1.8f, 0}, kinds[i]);
    r.quad({2, -1, 3}, {-4, 0, 0}, {0, 1.9f, 0}, r.w, r.light(Texture(Rgb(2, 1, 3))));
    return r.build();
}

std::shared_ptr<const Scene> phong() {
    return room_with_floor([](SceneBuilder& b) { return b.phong(Rgb(0), Rgb(0.8f, 0.7f, 0.6f), 40); });
}

/// Small squares seen directly, in a mirror, through glass and in glossy metal, for texture filtering.
std::shared_ptr<const Scene> squares_in_mirrors() {
    Room r;
    DiffuseMaterial checker;
    checker.reflectance.kind = CheckerboardTexture{Rgb(0.9f, 0.2f, 0.1f), Rgb(0.1f, 0.3f, 0.8f)};
    checker.reflectance.to_uv = glm::mat3(40, 0, 0, 0, 40, 0, 0, 0, 1);
    r.quad({-1, -0.99f, 1}, {2, 0, 0}, {0, 0, -2}, r.material({"squares", checker}));
    r.quad({-0.9f, -0.9f, -0.8f}, {0.8f, 0, 0}, {0, 1.2f, 0}, r.mirror());
    r.quad({0.1f, -0.9f, -0.8f}, {0.8f, 0, 0}, {0, 1.2f, 0}, r.conductor(0.05f));
    r.quad({-0.5f, -0.8f, 0.3f}, {0.6f, 0, 0}, {0, 0.6f, 0}, r.glass(1.5f, true));
    return r.build();
}

/// Slats and a glossy floor, out of focus in front and behind, and a blurred lamp.
std::shared_ptr<const Scene> thin_lens() {
    Room r;
    for (int i = 0; i < 5; ++i)
        r.quad({-0.9f, -0.8f + 0.35f * static_cast<float>(i), 0.5f}, {1.8f, 0, 0}, {0, 0.12f, 0.05f}, r.w);
    r.quad({-0.95f, -0.97f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, r.conductor(0.15f));
    Camera camera{look_at({0, 0, 2.6f}, {0, 0.25f, 0}), 60, FovAxis::x};
    camera.aperture_radius = 0.15f;
    camera.focus_distance = 3;
    r.camera(camera);
    return r.build();
}

std::shared_ptr<const Scene> orthographic() {
    Room r;
    r.sphere({0.35f, -0.55f, 0}, 0.35f, r.conductor(0.1f));
    Camera camera{glm::scale(look_at({0.4f, 0.3f, 2.6f}, {0, 0.1f, 0}), glm::vec3(0.9f, 0.9f, 1))};
    camera.is_orthographic = true;
    r.camera(camera);
    return r.build();
}

std::shared_ptr<const Scene> no_light() {
    SceneBuilder b;
    const int w = b.diffuse(white);
    b.room({w, w, w, w, w});
    b.camera({0, 0, 2.6f}, {0, 0, 0}, 50);
    return b.build();
}

} // namespace

std::vector<TestScene> all_test_scenes() {
    std::vector<TestScene> scenes = {
        {"diffuse", diffuse_room(), 5},
        {"depth_1", diffuse_room(), 1},
        {"depth_2", diffuse_room(), 2},
        {"depth_3", diffuse_room(), 3},
        {"depth_20", diffuse_room(), 20},
        {"glossy", glossy(), 5},
        {"beckmann", beckmann(), 5},
        {"brushed", brushed(), 5},
        {"brushed_half_vectors", brushed(), 5, 0.25f},
        {"nearly_mirror", nearly_mirror(), 5},
        {"glossy_half_vectors", glossy(), 5, 0.15f},
        {"nearly_mirror_half_vectors", nearly_mirror(), 6, 0.05f},
        {"plastic", plastic(), 5},
        {"rough_plastic", rough_plastic(), 5},
        {"mirror", mirror_floor(), 5, 0.001f, 4}, // rare bright paths
        {"glass", glass_ball(), 7},
        {"thin_panes", thin_panes(), 6},
        {"blinds", blinds(), 4},
        {"texture_edges", texture_edges(), 4},
        {"black_texels", black_texels(), 4},
        {"grazing", grazing(), 4},
        {"patchwork", patchwork(), 5, 0.001f, 5},
        {"patchwork_half_vectors", patchwork(), 5, 0.1f, 5},
        {"glossy_second_vertex", glossy_second_vertex(), 3, 0.1f, 4},
        {"rough_glass", rough_glass(), 7},
        {"rough_glass_half_vectors", rough_glass(), 7, 0.25f},
        {"principled", principled(0.3f, 0.7f, 0.4f), 6},
        {"principled_half_vectors", principled(1, 1, 1), 6, 0.4f},
        {"ward_half_vectors", ward(), 5, 0.5f},
        {"translucent", translucent(), 6},
        {"translucent_half_vectors", translucent(), 6, 0.5f},
        {"blends", blends(), 6},
        {"blends_half_vectors", blends(), 6, 0.35f},
        {"coated", coated(), 5},
        {"phong_half_vectors", phong(), 5, 0.5f},
        {"shining_wall", shining_wall(), 4},
        {"short_edges", blinds(), 4, 0.001f, 1, 20},
        {"glass_in_plastic", glass_in_plastic(), 6, 0.001f, 3, 2},
        {"lamp_in_mirrors", lamp_in_mirrors(), 5},
        {"squares_in_mirrors", squares_in_mirrors(), 5, 0.001f, 4},
        {"thin_lens", thin_lens(), 4, 0.001f, 2},
        {"orthographic", orthographic(), 4},
        {"no_light", no_light(), 4},
    };
    for (TestScene& scene : light_scenes())
        scenes.push_back(std::move(scene));
    return scenes;
}

} // namespace tessera::test
