#include "tests/support/scene_builder.h"

namespace tessera::test {

namespace {

const Rgb white(0.75f);
const Rgb red(0.63f, 0.065f, 0.05f);
const Rgb green(0.14f, 0.45f, 0.091f);

/// A diffuse room, lit by half of its ceiling, so that a naive path tracer finds the light often.
struct Room : SceneBuilder {
    int w = diffuse(white), r = diffuse(red), g = diffuse(green), black = diffuse(Rgb(0));
    int lamp = light(Rgb(5, 4, 3));

    explicit Room(int floor = -1, int back = -1) {
        room({floor < 0 ? w : floor, w, back < 0 ? w : back, r, g});
        ceiling_light(black);
        camera({0, 0, 2.6f}, {0, 0, 0}, 50);
    }
    void ceiling_light(int material) { quad({-0.7f, 0.98f, -0.7f}, {1.4f, 0, 0}, {0, 0, 1.4f}, material, lamp); }
};

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

/// A window pane across half of the view, and a mirror of glass on the wall.
std::shared_ptr<const Scene> thin_panes() {
    Room r;
    r.quad({-0.9f, -0.9f, 0.4f}, {0.9f, 0, 0.2f}, {0, 1.6f, 0}, r.glass(1.5f, true));
    r.quad({0.2f, -0.7f, -0.9f}, {0.7f, 0, 0.1f}, {0, 1.2f, 0}, r.glass(3.0f, true));
    return r.build();
}

/// Slats between the tile's points and the rest of the room.
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

/// The lamp reflects light too, stands free and has a dark back; a one-sided wall is black from behind.
std::shared_ptr<const Scene> shining_wall() {
    Room r;
    r.quad({-0.5f, -0.6f, -0.3f}, {0.8f, 0, -0.3f}, {0, 0.9f, 0}, r.w, r.lamp);
    const int one_sided = r.material({"one-sided", DiffuseMaterial{{white}}, false});
    r.quad({0.5f, -0.5f, 0.2f}, {-0.3f, 0, 0}, {0, 0.7f, 0}, one_sided);
    return r.build();
}

/// Diffuse walls that see a small lamp by way of a panel too glossy to connect to, past posts that hide the panel
/// from one pixel and not from the next.
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

/// Without a ceiling: an environment above, uneven, turned, and with a sun.
struct OpenRoom : SceneBuilder {
    int w = diffuse(white), r = diffuse(red);

    OpenRoom() {
        quad({-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, w);
        quad({-1, -1, -1}, {2, 0, 0}, {0, 1.2f, 0}, w);
        quad({-1, -1, 1}, {0, 0, -2}, {0, 1.2f, 0}, r);
        sphere({0.35f, -0.6f, 0}, 0.35f, w);
        camera({0, 0.2f, 2.6f}, {0, -0.4f, 0}, 50);
    }
    void sky() {
        std::vector<Rgb> pixels;
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 9; ++x)
                pixels.push_back(y > 3 ? Rgb(0) : Rgb(0.2f + 0.3f * float(x % 3), 0.5f, 0.4f + 0.3f * float(y)));
        environment(pixels, 9, glm::mat3(0, 0, -1, 0.6f, 0.8f, 0, 0.8f, -0.6f, 0));
    }
};

std::shared_ptr<const Scene> constant_environment() {
    OpenRoom r;
    r.environment({Rgb(0.8f, 0.9f, 1)}, 1);
    return r.build();
}
std::shared_ptr<const Scene> environment() {
    OpenRoom r;
    r.sky();
    return r.build();
}
std::shared_ptr<const Scene> sun() {
    OpenRoom r;
    r.sky();
    r.sun({glm::normalize(glm::vec3(1, 2, 1)), 0.3f, Rgb(6, 5, 4)});
    return r.build();
}

/// An environment seen in mirror, glass and gloss, and a lamp beside it.
std::shared_ptr<const Scene> environment_patchwork() {
    OpenRoom r;
    r.sky();
    const int materials[] = {r.mirror(), r.conductor(0.05f), r.w, r.glass(), r.conductor(0.3f), r.r};
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 4; ++j)
            r.quad({-0.9f + 0.3f * float(i), -0.9f + 0.3f * float(j), -0.2f}, {0.28f, 0, 0.02f},
                   {0, 0.28f, -0.05f}, materials[(i + 2 * j) % 6]);
    r.quad({-0.9f, 0.9f, 0}, {0.8f, 0, 0}, {0, 0, 0.8f}, r.w, r.light(Rgb(2, 1, 3)));
    return r.build();
}
std::shared_ptr<const Scene> environment_gloss() {
    OpenRoom r;
    r.sky();
    r.quad({-0.95f, -0.95f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, r.conductor(0.08f));
    return r.build();
}

/// Lights without extent, one in a cone that falls off, one beside a glossy floor.
std::shared_ptr<const Scene> point_lights() {
    OpenRoom r;
    r.quad({-0.95f, -0.95f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, r.conductor(0.2f));
    r.quad({1, -1, -1}, {0, 0, 2}, {0, 1.2f, 0}, r.w);
    r.point({{-0.4f, 0.5f, 0.3f}, Rgb(0.5f, 0.8f, 0.6f)});
    r.point({{0.5f, 1.0f, 0.5f}, Rgb(2, 1, 1), glm::normalize(glm::vec3(-0.3f, -1, -0.5f)), 35, 10});
    r.directional({glm::normalize(glm::vec3(0.4f, 1, 0.7f)), Rgb(0.3f, 0.4f, 0.9f)});
    r.quad({-0.3f, -0.2f, 0.3f}, {0.5f, 0, 0}, {0, 0.1f, -0.3f}, r.w);
    return r.build();
}

/// A light whose radiance is a pattern, in part black, beside a plain one of another kind.
std::shared_ptr<const Scene> textured_light() {
    Room r;
    Texture pattern;
    pattern.kind = CheckerboardTexture{Rgb(4, 2, 1), Rgb(0, 0.5f, 3)};
    pattern.to_uv = glm::mat3(2.5f);
    r.quad({-0.6f, -0.5f, -0.9f}, {1.2f, 0, 0}, {0, 1, 0}, r.black, r.light(pattern));
    return r.build();
}

/// Panes that half of the light passes, one of them with holes, in front of the room and of the light.
std::shared_ptr<const Scene> masks() {
    Room r;
    Material half{"half", DiffuseMaterial{{white}}, true};
    half.opacity = Texture(Rgb(0.5f));
    const int m = r.material(half);
    Texture holes;
    holes.kind = CheckerboardTexture{Rgb(0.1f), Rgb(0.9f)};
    holes.to_uv = glm::mat3(3.0f);
    half.opacity = holes;
    const int n = r.material(half);
    r.quad({-0.9f, -0.9f, 0.4f}, {0.9f, 0, 0.2f}, {0, 1.6f, 0}, m);
    r.quad({-0.8f, 0.6f, -0.8f}, {1.6f, 0, 0}, {0, 0, 1.6f}, n);
    return r.build();
}

/// Such panes in front of a glossy floor, a sky and a sun.
std::shared_ptr<const Scene> masks_outside() {
    OpenRoom r;
    r.sky();
    r.sun({glm::normalize(glm::vec3(1, 2, 1)), 0.3f, Rgb(6, 5, 4)});
    Material half{"half", DiffuseMaterial{{white}}, true};
    half.opacity = Texture(Rgb(0.4f));
    const int m = r.material(half);
    r.quad({-0.95f, -0.95f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, r.conductor(0.12f));
    r.quad({-0.9f, -0.9f, 0.5f}, {0.9f, 0, 0.2f}, {0, 1.6f, 0}, m);
    r.quad({-0.8f, 0.6f, -0.8f}, {1.6f, 0, 0}, {0, 0, 1.6f}, m);
    return r.build();
}

/// Waves on a glossy floor and a wall, by their normals alone.
std::shared_ptr<const Scene> relief() {
    Room r;
    Bitmap waves;
    waves.width = waves.height = 8;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            waves.floats.emplace_back(0.02f * float((x * 3 + y * 5) % 4));
    Relief bump;
    bump.map.kind = BitmapTexture{std::make_shared<const Bitmap>(waves)};
    Material wall{"wall", DiffuseMaterial{{white}}, true};
    wall.relief = bump;
    ConductorMaterial metal;
    metal.alpha = Texture(Rgb(0.2f));
    Material floor{"floor", metal, true};
    floor.relief = bump;
    r.quad({-0.95f, -0.97f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, r.material(floor));
    r.quad({-0.95f, -0.95f, -0.97f}, {1.9f, 0, 0}, {0, 1.9f, 0}, r.material(wall));
    return r.build();
}

/// Two balls of different indices: light goes through one, both, or from one to the other.
std::shared_ptr<const Scene> rough_glass() {
    Room r;
    r.sphere({-0.3f, -0.4f, 0}, 0.5f, r.rough_glass(0.3f));
    r.sphere({0.5f, -0.5f, 0.2f}, 0.4f, r.rough_glass(0.2f, 1.33f));
    return r.build();
}

/// Sums of what scatters, reflects and refracts, smooth and rough.
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

std::shared_ptr<const Scene> phong() {
    return room_with_floor([](SceneBuilder& b) { return b.phong(Rgb(0), Rgb(0.8f, 0.7f, 0.6f), 40); });
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
    return {
        {"diffuse", diffuse_room(), 5},
        {"depth_1", diffuse_room(), 1},
        {"depth_2", diffuse_room(), 2},
        {"depth_3", diffuse_room(), 3},
        {"depth_20", diffuse_room(), 20},
        {"glossy", glossy(), 5},
        {"beckmann", beckmann(), 5},
        {"nearly_mirror", nearly_mirror(), 5},
        {"glossy_half_vectors", glossy(), 5, 0.15f},
        {"nearly_mirror_half_vectors", nearly_mirror(), 6, 0.05f},
        {"plastic", plastic(), 5},
        {"rough_plastic", rough_plastic(), 5},
        {"mirror", mirror_floor(), 5},
        {"glass", glass_ball(), 7},
        {"thin_panes", thin_panes(), 6},
        {"blinds", blinds(), 4},
        {"texture_edges", texture_edges(), 4},
        {"grazing", grazing(), 4},
        {"patchwork", patchwork(), 5, 0.001f, 5},
        {"patchwork_half_vectors", patchwork(), 5, 0.1f, 5},
        {"glossy_second_vertex", glossy_second_vertex(), 3, 0.1f, 4},
        {"rough_glass", rough_glass(), 7},
        {"rough_glass_half_vectors", rough_glass(), 7, 0.25f},
        {"blends", blends(), 6},
        {"blends_half_vectors", blends(), 6, 0.35f},
        {"coated", coated(), 5},
        {"phong_half_vectors", phong(), 5, 0.5f},
        {"shining_wall", shining_wall(), 4},
        {"no_light", no_light(), 4},
        {"constant_environment", constant_environment(), 5},
        {"environment", environment(), 5},
        {"environment_depth_2", environment(), 2},
        {"sun", sun(), 4},
        {"environment_patchwork", environment_patchwork(), 5, 0.001f, 3},
        {"environment_half_vectors", environment_patchwork(), 4, 0.1f, 3},
        {"environment_gloss", environment_gloss(), 4, 0.1f},
        {"point_lights", point_lights(), 4},
        {"point_lights_half_vectors", point_lights(), 4, 0.3f},
        {"textured_light", textured_light(), 4},
        {"masks", masks(), 4},
        {"masks_outside", masks_outside(), 4},
        {"masks_outside_half_vectors", masks_outside(), 4, 0.15f},
        {"lamp_and_sky_in_gloss", environment_patchwork(), 2, 0.35f, 3},
        {"relief", relief(), 4},
        {"relief_half_vectors", relief(), 4, 0.25f},
    };
}

} // namespace tessera::test
