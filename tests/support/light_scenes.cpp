// Test scenes for lights of all kinds, masks, instances and relief.
#include "tests/support/rooms.h"

#include <memory>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace tessera::test {

namespace {

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

/// Mirror, glass, glossy and diffuse squares under an environment and a lamp.
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

/// Point lights, one of them with a cone, and a directional light, above a glossy floor.
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

/// A projector and a spot light with a pattern, above a glossy floor.
std::shared_ptr<const Scene> slides() {
    OpenRoom r;
    r.quad({-0.95f, -0.95f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, r.conductor(0.2f));
    r.quad({1, -1, -1}, {0, 0, 2}, {0, 1.2f, 0}, r.w);
    Texture pattern;
    pattern.kind = CheckerboardTexture{Rgb(4, 2, 1), Rgb(0, 0.5f, 3)};
    pattern.to_uv = glm::mat3(2.5f);
    const glm::vec3 at(0.2f, 0.8f, 0.9f), spot(-0.6f, 0.7f, 0.5f);
    PointLight projector{at, Rgb(0.3f)};
    projector.slide = Slide{
        pattern, {glm::mat4(glm::mat3(look_at(at, {-0.2f, -1, -0.5f}))), 60, FovAxis::x}, Slide::Kind::irradiance};
    const glm::mat3 down(look_at(spot, {0, -1, 0}));
    PointLight cone{spot, Rgb(1), down[2], 40, 25};
    cone.slide = Slide{pattern, {glm::mat4(down), 80, FovAxis::x}, Slide::Kind::share};
    r.point(projector);
    r.point(cone);
    return r.build();
}

/// A lamp with a partly black pattern, beside a plain lamp.
std::shared_ptr<const Scene> textured_light() {
    Room r;
    Texture pattern;
    pattern.kind = CheckerboardTexture{Rgb(4, 2, 1), Rgb(0, 0.5f, 3)};
    pattern.to_uv = glm::mat3(2.5f);
    r.quad({-0.6f, -0.5f, -0.9f}, {1.2f, 0, 0}, {0, 1, 0}, r.black, r.light(pattern));
    return r.build();
}

/// Masks in front of the room and of the lamp: one of constant opacity, one with a pattern.
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
    r.ball({0.4f, -0.6f, 0}, 0.35f, n);
    return r.build();
}

/// Masks in front of a glossy floor, a sky and a sun.
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

/// Bump maps on a glossy floor and a wall.
std::shared_ptr<const Scene> relief() {
    Room r;
    Bitmap waves;
    waves.width = waves.height = 8;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            waves.floats.emplace_back(0.02f * float((x * 3 + y * 5) % 4));
    Relief bump;
    bump.map.kind = BitmapTexture{std::make_shared<const Bitmap>(waves)};
    bump.turns_to_viewer = true;
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

/// Returns the matrix that scales, turns and moves a unit shape.
glm::mat4 placed(glm::vec3 to, float angle, glm::vec3 size) {
    return glm::scale(glm::rotate(glm::translate(glm::mat4(1), to), angle, glm::vec3(0.6f, 0.8f, 0)), size);
}

/// Two instances of a group of a glossy sphere and a leaf, with rotation, uneven scale and mirroring.
std::shared_ptr<const Scene> instances() {
    Room r;
    r.sphere({0, 0, 0}, 0.4f, r.plastic(red, 0.25f), 12);
    r.quad({-0.5f, -0.3f, 0.45f}, {1, 0, 0}, {0, 0.5f, 0}, r.material({"leaf", DiffuseMaterial{{white}}, true}));
    const int group = r.group_of_last(2);
    r.instance(group, placed({-0.4f, -0.5f, 0.1f}, 0.7f, {1, 0.6f, 0.8f}));
    r.instance(group, placed({0.45f, -0.3f, -0.3f}, -0.5f, {-0.7f, 1.3f, 0.9f}));
    return r.build();
}

/// Emitting spheres, outside and inside, an ellipsoid, a cylinder and a disk, above a glossy floor.
std::shared_ptr<const Scene> round_lamps() {
    using Kind = Quadric::Kind;
    SceneBuilder r;
    const int w = r.diffuse(white), black = r.diffuse(Rgb(0));
    r.room({r.conductor(0.2f), w, w, r.diffuse(red), r.diffuse(green)});
    Texture pattern;
    pattern.kind = CheckerboardTexture{Rgb(6, 2, 1), Rgb(1, 3, 5)};
    pattern.to_uv = glm::mat3(3.0f);
    r.ball({-0.5f, 0.3f, 0.1f}, 0.3f, w, r.light(pattern));
    r.ball({0.4f, -0.6f, 0.3f}, 0.25f, black, r.light(Rgb(3, 2, 4)));
    r.quadric(Quadric(Kind::sphere, placed({0.5f, 0.5f, -0.3f}, 0.6f, {0.2f, 0.4f, 0.25f}), false), black,
              r.light(Rgb(4, 3, 2)));
    r.quadric(Quadric(Kind::cylinder, placed({-0.6f, -0.8f, -0.3f}, 0.9f, {0.2f, 0.2f, 0.8f}), false), w,
              r.light(Rgb(2)));
    r.quadric(Quadric(Kind::disk, placed({0, 0.9f, -0.2f}, 1.8f, {0.4f, 0.2f, 1}), false), black, r.light(Rgb(5)));
    r.quadric(Quadric(Kind::sphere, placed({0, 0, 0}, 0, glm::vec3(6)), true), black, r.light(Rgb(0.3f)));
    r.camera({0, 0, 2.6f}, {0, 0, 0}, 50);
    return r.build();
}

/// Spheres of glass and metal, a textured ellipsoid, a brushed cylinder, and instances of a group.
std::shared_ptr<const Scene> quadrics() {
    using Kind = Quadric::Kind;
    Room r;
    r.ball({-0.5f, -0.6f, 0.3f}, 0.35f, r.glass());
    r.ball({0.4f, 0.4f, -0.4f}, 0.3f, r.plastic(red, 0.25f));
    DiffuseMaterial checker;
    checker.reflectance.kind = CheckerboardTexture{Rgb(0.9f, 0.1f, 0), Rgb(0, 0.2f, 0.8f)};
    checker.reflectance.to_uv = glm::mat3(7.0f);
    r.quadric(Quadric(Kind::sphere, placed({0.4f, -0.5f, 0.1f}, 0.6f, {0.3f, 0.45f, 0.25f}), false),
              r.material({"checker", checker, true}));
    r.quadric(Quadric(Kind::cylinder, placed({-0.6f, 0.2f, -0.4f}, 0.9f, {0.2f, 0.2f, 0.8f}), false),
              r.brushed(0.1f, 0.4f));
    r.ball({0, 0, 0}, 0.25f, r.conductor(0.15f));
    r.quadric(Quadric(Kind::disk, placed({0, 0.3f, 0}, 1.5f, glm::vec3(0.3f)), false), r.w);
    const int group = r.group_of_last(2);
    r.instance(group, placed({0, -0.6f, -0.5f}, 0.7f, {1, 0.6f, 0.8f}));
    r.instance(group, placed({-0.1f, 0.5f, 0.3f}, -0.5f, {-0.7f, 1.3f, 0.9f}));
    return r.build();
}

} // namespace

std::vector<TestScene> light_scenes() {
    return {
        {"constant_environment", constant_environment(), 5},
        {"environment", environment(), 5},
        {"environment_depth_2", environment(), 2},
        {"sun", sun(), 4},
        {"environment_patchwork", environment_patchwork(), 5, 0.001f, 3},
        {"environment_half_vectors", environment_patchwork(), 4, 0.1f, 3},
        {"environment_gloss", environment_gloss(), 4, 0.1f},
        {"point_lights", point_lights(), 4, 0.001f, 2},
        {"point_lights_half_vectors", point_lights(), 4, 0.3f, 2},
        {"slides", slides(), 4, 0.001f, 4},
        {"textured_light", textured_light(), 4},
        {"masks", masks(), 4},
        {"masks_outside", masks_outside(), 4},
        {"masks_outside_half_vectors", masks_outside(), 4, 0.15f},
        {"lamp_and_sky_in_gloss", environment_patchwork(), 2, 0.35f, 3},
        {"instances", instances(), 4},
        {"instances_half_vectors", instances(), 4, 0.3f},
        {"round_lamps", round_lamps(), 4},
        {"round_lamps_half_vectors", round_lamps(), 4, 0.3f},
        {"quadrics", quadrics(), 6},
        {"quadrics_half_vectors", quadrics(), 5, 0.3f},
        {"relief", relief(), 4},
        {"relief_half_vectors", relief(), 4, 0.25f},
    };
}

} // namespace tessera::test
