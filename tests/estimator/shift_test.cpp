// Light paths through an x_2 that is too glossy to be connectable: half-vector copies must shift them, also when
// the direct edge from y_1 to x_2, which they do not use, is blocked.
#include "render/scene/scene.h"
#include "tests/support/one_shift.h"
#include "tests/support/scene_builder.h"

#include <cstdint>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(64, 48);

TestScene scene_named(const std::string& name) {
    for (TestScene& t : all_test_scenes())
        if (t.name == name)
            return t;
    throw std::runtime_error("no scene " + name);
}

/// Results of shifting many base paths, with emitter sampling at a glossy x_2, to the pixel on the right.
struct Tally {
    int light_is_last = 0;        ///< base paths whose last light path ends by emitter sampling at x_2
    int shifted = 0;              ///< successful shifts of these
    int blocked = 0;              ///< base paths whose x_2 is not visible from y_1
    int shifted_past_blocked = 0; ///< successful shifts of these
};

Tally tally(const TestScene& t) {
    Tally sum;
    Counters counters;
    PathSettings path_settings;
    path_settings.max_depth = t.max_depth;
    const Tracer tracer{*t.scene, counters, path_settings};
    const ShiftSettings shift_settings{ShiftKind::half_vector, t.shift_threshold, t.shift_distance};
    const Projection projection(t.scene->camera(), size);
    LightPaths light;
    OffsetPaths paths;
    for (int pass = 0; pass < 40; ++pass)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x + 1 < size.x; ++x) {
                BasePath base, right;
                const glm::vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
                const auto pixel = static_cast<std::uint32_t>(y * size.x + x);
                trace_base_path(tracer, projection.ray(p), projection.pixel_width(),
                                {7, pixel, std::uint32_t(pass)}, base);
                trace_base_path(tracer, projection.ray(p + glm::vec2(1, 0)), projection.pixel_width(),
                                {7, pixel + 1, 0}, right);
                if (base.size() < 2 || right.empty())
                    continue;
                light.reset(base, shift_settings);
                const int slot = light.emitter_slot(1);
                if (base[1].vertex.bsdf.roughness() > t.shift_threshold || !light.is_alive(slot))
                    continue;
                shift_to_one(tracer, shift_settings, base, light, right, paths, true);
                const bool shifted = paths.ratio(slot, 0) > 0;
                if (light.last_alive() == slot) {
                    ++sum.light_is_last;
                    sum.shifted += shifted;
                }
                const Vertex &from = right[0].vertex, &to = base[1].vertex;
                const glm::vec3 direction = glm::normalize(to.position - from.position);
                if (tracer.occluded(tracer.between(from.position, from.geometric_normal, to.position,
                                                   to.geometric_normal, direction),
                                    RayKind::shift_edge)) {
                    ++sum.blocked;
                    sum.shifted_past_blocked += shifted;
                }
            }
    return sum;
}

TEST(Shift, ShiftsLightBeyondAGlossySecondVertex) {
    const Tally t = tally(scene_named("glossy_second_vertex"));
    ASSERT_GT(t.light_is_last, 200);
    EXPECT_GT(t.shifted, t.light_is_last / 10); // the copied direction must find the lamp
    ASSERT_GT(t.blocked, 10);
    EXPECT_GT(t.shifted_past_blocked, 0);
}

} // namespace

} // namespace tessera::test
