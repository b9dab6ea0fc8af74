#pragma once

#include "tests/support/scene_builder.h"

#include <glm/mat3x3.hpp>

namespace tessera::test {

inline const Rgb white(0.75f);
inline const Rgb red(0.63f, 0.065f, 0.05f);
inline const Rgb green(0.14f, 0.45f, 0.091f);

/// A diffuse room with a lamp on half of its ceiling, which naive path tracing often hits.
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

/// A room without a ceiling, for environments.
struct OpenRoom : SceneBuilder {
    int w = diffuse(white), r = diffuse(red);

    OpenRoom() {
        quad({-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, w);
        quad({-1, -1, -1}, {2, 0, 0}, {0, 1.2f, 0}, w);
        quad({-1, -1, 1}, {0, 0, -2}, {0, 1.2f, 0}, r);
        sphere({0.35f, -0.6f, 0}, 0.35f, w);
        camera({0, 0.2f, 2.6f}, {0, -0.4f, 0}, 50);
    }
    /// Adds an uneven, rotated environment.
    void sky() {
        std::vector<Rgb> pixels;
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 9; ++x)
                pixels.push_back(y > 3 ? Rgb(0) : Rgb(0.2f + 0.3f * float(x % 3), 0.5f, 0.4f + 0.3f * float(y)));
        environment(pixels, 9, glm::mat3(0, 0, -1, 0.6f, 0.8f, 0, 0.8f, -0.6f, 0));
    }
};

} // namespace tessera::test
