// The inspection of one sample of one pixel has the same values as the render.
#include "render/estimator/tile_grid.h"
#include "render/inspect/inspection.h"
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/rooms.h"

#include <cmath>
#include <map>
#include <numeric>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(23, 14);

struct Case {
    const char* name;
    Method method;
    ShiftKind shift = ShiftKind::half_vector;
    Pattern pattern = Pattern::tile;
};
void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

class Inspected : public testing::TestWithParam<Case> {
protected:
    Inspected() {
        settings.method = GetParam().method;
        settings.shift = GetParam().shift;
        settings.pattern = GetParam().pattern;
        settings.tile = 5;
        settings.max_depth = 5;
        settings.seed = 3;
    }
    std::shared_ptr<const Scene> scene = glossy_room();
    RenderSettings settings;
    ThreadPool pool{1};

    static std::shared_ptr<const Scene> glossy_room() {
        SceneBuilder room;
        const int white = room.diffuse(Rgb(0.75f));
        room.room({white, room.conductor(0.2f), white, room.mirror(), white});
        room.quad({-0.4f, 0.98f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}, white, room.light(Rgb(9, 8, 6)));
        room.sphere({0.3f, -0.55f, 0.1f}, 0.45f, room.glass());
        room.camera({0, 0, 3.4f}, {0, 0, 0}, 40);
        return room.build();
    }
};

TEST_P(Inspected, RadianceIsWhatThePassAdds) {
    const glm::ivec2 pixels[] = {{0, 0}, {11, 7}, {22, 13}, {4, 9}, {15, 10}};
    Render render(scene, scene->camera(), size, settings);
    std::vector<Rgb> sums(std::size(pixels), Rgb(0));
    for (int pass = 0; pass < 3; ++pass) {
        render.pass(pool);
        const GradientImages images = render.images();
        for (std::size_t n = 0; n < std::size(pixels); ++n) {
            const glm::ivec2 p = pixels[n];
            const Inspection seen =
                inspect(*scene, scene->camera(), size, settings, *render.newest_learned(), pass, p);
            sums[n] += seen.shared_radiance();
            const Rgb mean = sums[n] / static_cast<float>(pass + 1), expected = images.radiance()(p.x, p.y);
            EXPECT_LE(glm::distance(mean, expected), 1e-4f * (1e-2f + glm::length(expected)))
                << p.x << ',' << p.y << " pass " << pass;
        }
    }
}

TEST_P(Inspected, ShiftsHaveOutcomesAndVertices) {
    settings.adapt_tile = false; // pixels without reuse have no shifts
    Render render(scene, scene->camera(), size, settings);
    render.pass(pool);
    int reconnected = 0;
    for (int x = 0; x < size.x; ++x) {
        const Inspection seen =
            inspect(*scene, scene->camera(), size, settings, *render.newest_learned(), 0, {x, 8});
        for (const InspectedSet& set : seen.sets) {
            EXPECT_EQ(set.to(seen.pixel).size(), set.pixels.size());
            EXPECT_EQ(set.from(seen.pixel).size() + 1, set.pixels.size());
            for (const InspectedShift* shift : set.from(seen.pixel)) {
                const InspectedShift& s = *shift;
                EXPECT_EQ(s.from, seen.pixel);
                EXPECT_NE(s.to, seen.pixel);
                EXPECT_EQ(s.is_tried && s.outcome == ShiftOutcome::ok, !is_black(s.value));
                EXPECT_EQ(s.ratio > 0, !is_black(s.value));
                reconnected += !s.offset.empty() && !s.beyond.empty();
                if (!s.beyond.empty()) { // the reused part ends as the base path does
                    EXPECT_EQ(s.beyond.back(), seen.path.back().position);
                }
            }
        }
    }
    EXPECT_EQ(reconnected > 0, settings.method != Method::pt && settings.shift != ShiftKind::replay);
}

/// The product of the Jacobians of a shift's steps is the Jacobian that the estimator uses.
TEST_P(Inspected, StepsGiveTheRatioAndTheJacobian) {
    settings.adapt_tile = false; // pixels without reuse have no shifts
    Render render(scene, scene->camera(), size, settings);
    render.pass(pool);
    int seen_steps = 0, stretched = 0;
    for (int x = 0; x < size.x; ++x) {
        const Inspection seen =
            inspect(*scene, scene->camera(), size, settings, *render.newest_learned(), 0, {x, 9});
        for (const InspectedSet& set : seen.sets)
            for (const InspectedShift* s : set.to(seen.pixel)) {
                if (is_black(s->value) || !s->is_tried)
                    continue;
                ASSERT_FALSE(s->steps.empty());
                float jacobian = 1;
                for (const InspectedStep& step : s->steps)
                    jacobian *= step.shifted.jacobian;
                EXPECT_FLOAT_EQ(s->jacobian, jacobian);
                EXPECT_GT(jacobian, 0);
                EXPECT_FALSE(s->ending.empty());
                if (s->from == s->to) {
                    EXPECT_FLOAT_EQ(jacobian, 1);
                    continue;
                }
                ++seen_steps;
                stretched += std::abs(jacobian - 1) > 1e-3f;
                EXPECT_FLOAT_EQ(s->steps.back().shifted.ratio, s->ratio);
                // The shift's value sums over all light paths of the base path, so this light path is at most as
                // bright.
                EXPECT_GE(luminance(s->value) * 1.0001f, luminance(s->steps.back().shifted.value) * s->weight);
            }
    }
    EXPECT_EQ(seen_steps > 0, settings.method != Method::pt);
    EXPECT_EQ(stretched > 0, settings.method != Method::pt && settings.shift != ShiftKind::replay);
}

/// The footprints of a shifted path are those of a path that its pixel samples. The pixel's own path confirms it.
TEST_P(Inspected, ShiftedPathsHaveFootprints) {
    settings.adapt_tile = false; // pixels without reuse have no shifts
    Render render(scene, scene->camera(), size, settings);
    render.pass(pool);
    int own = 0, shifted = 0;
    for (int x = 0; x < size.x; ++x) {
        const Inspection seen =
            inspect(*scene, scene->camera(), size, settings, *render.newest_learned(), 0, {x, 9});
        for (const InspectedSet& set : seen.sets)
            for (const InspectedShift* s : set.to(seen.pixel))
                for (std::size_t i = 0; i < s->steps.size(); ++i) {
                    const float width = glm::length(s->steps[i].footprint.a);
                    EXPECT_GT(width, 0);
                    EXPECT_FLOAT_EQ(width * width, s->steps[i].footprint.area());
                    if (s->from != s->to) {
                        ++shifted;
                        continue;
                    }
                    if (&set != seen.sets.data())
                        continue; // another path of a pixel without reuse
                    ++own;
                    // On spheres, shading normals differ from the normals of the triangles.
                    const bool is_flat = i == 0 && s->steps[i].vertex.bsdf != "dielectric";
                    EXPECT_NEAR(width / seen.path[i].footprint_width, 1, is_flat ? 1e-4f : 0.2f);
                }
    }
    if (settings.method == Method::pt)
        return;
    EXPECT_GT(shifted, 0);
    EXPECT_GT(own, 0);
}

/// The inspection of a whole tile gives each pixel the radiance that the pass adds.
TEST_P(Inspected, TileMatchesThePass) {
    Render render(scene, scene->camera(), size, settings);
    render.pass(pool);
    const RgbImage primal = render.images().radiance();
    const TileInspection tile =
        inspect_tile(*scene, scene->camera(), size, settings, *render.newest_learned(), 0, {12, 7});
    EXPECT_TRUE(tile.tile.contains({12, 7}));
    int bases = 0;
    std::map<std::pair<int, int>, std::vector<Rgb>>
        radiance_by_pixel; // a pixel without reuse has one set per path
    for (const InspectedSet& set : tile.sets) {
        bases += set.size();
        ASSERT_EQ(set.bases.size(), set.pixels.size());
        ASSERT_EQ(set.shifts.size(), set.pixels.size() * set.pixels.size());
        for (int m = 0; m < set.size(); ++m) {
            const InspectedBase& base = set.base(m);
            EXPECT_TRUE(base.reuse.survives() || is_black(set.shift(m, (m + 1) % set.size()).value) ||
                        set.size() == 1);
            if (set.is_border[static_cast<std::size_t>(m)] || settings.method == Method::gpt)
                continue;
            const glm::ivec2 p = set.pixels[static_cast<std::size_t>(m)];
            radiance_by_pixel[{p.x, p.y}].push_back(set.radiance(p));
        }
    }
    EXPECT_EQ(bases, tile.base_count());
    const PixelRect inside = tile.tile.clipped(size);
    if (settings.method != Method::gpt) {
        EXPECT_EQ(radiance_by_pixel.size(), static_cast<std::size_t>(inside.width() * inside.height()));
    }
    for (const auto& [p, found] : radiance_by_pixel) {
        Rgb mean = std::accumulate(found.begin(), found.end(), Rgb(0)) / static_cast<float>(found.size());
        if (settings.method == Method::gpr) { // a pixel in the sets of several tiles gets their mean
            const Inspection seen =
                inspect(*scene, scene->camera(), size, settings, *render.newest_learned(), 0, {p.first, p.second});
            EXPECT_TRUE(std::ranges::any_of(
                seen.sets, [&](const auto& set) { return set.radiance(seen.pixel) == found[0]; }));
            mean = seen.shared_radiance();
        }
        const Rgb rendered = primal(p.first, p.second);
        EXPECT_LE(glm::distance(mean, rendered), 1e-4f * (1e-2f + glm::length(rendered)));
    }
}

TEST(Inspection, SetsAreTheTilesOfThePass) {
    RenderSettings settings;
    settings.method = Method::pr;
    settings.tile = 5;
    settings.adapt_tile = false;
    const auto scene = Room().build();
    const LearnedReuse learned(size, settings);
    for (int pass = 0; pass < 4; ++pass) {
        const TileGrid grid(size, settings, learned, pass);
        const PixelRect split = grid.split_at({12, 7});
        const Inspection seen = inspect(*scene, scene->camera(), size, settings, learned, pass, {12, 7});
        ASSERT_EQ(seen.sets.size(), 1u);
        EXPECT_EQ(seen.sets[0].pixels.size(), static_cast<std::size_t>(split.width() * split.height()));
        for (const glm::ivec2 p : seen.sets[0].pixels)
            EXPECT_TRUE(split.contains(p));
        int splits_with_pixel = 0;
        grid.for_each_split({grid.origin.x, grid.origin.y, 30, 20}, [&](PixelRect other, int) {
            if (other.contains({12, 7})) {
                ++splits_with_pixel;
                EXPECT_EQ(other.x0, split.x0);
                EXPECT_EQ(other.y1, split.y1);
            }
        });
        EXPECT_EQ(splits_with_pixel, 1);
    }
}

TEST(Inspection, GptPixelsReusePathsOfNeighboursInTheirBlock) {
    RenderSettings settings;
    settings.method = Method::gpt;
    settings.max_depth = 4;
    const auto scene = Room().build();
    const glm::ivec2 image(50, 30); // blocks have 24 x 24 pixels
    ThreadPool pool{1};
    Render render(scene, scene->camera(), image, settings);
    render.pass(pool);
    const RgbImage primal = render.images().radiance();
    const std::pair<glm::ivec2, std::size_t> pixels[] = {{{30, 10}, 4}, {{23, 23}, 4}, {{24, 10}, 3},
                                                         {{24, 24}, 2}, {{0, 0}, 2},   {{49, 29}, 2}};
    for (const auto& [p, sets] : pixels) {
        const Inspection seen = inspect(*scene, scene->camera(), image, settings, *render.newest_learned(), 0, p);
        EXPECT_EQ(seen.sets.size(), sets) << p.x << ',' << p.y;
        EXPECT_LE(glm::distance(seen.shared_radiance(), primal(p.x, p.y)),
                  1e-5f * (1e-2f + glm::length(primal(p.x, p.y))));
    }
}

TEST(Inspection, ProjectionInvertsTheCameraRay) {
    const auto scene = Room().build();
    const Projection projection(scene->camera(), size);
    const Ray ray = projection.ray({3.25f, 9.5f});
    const glm::vec4 p = projection.project(ray.origin + 2.5f * ray.direction);
    EXPECT_GT(p.z, 0);
    EXPECT_NEAR(p.x / p.w, 3.25f, 1e-3f);
    EXPECT_NEAR(p.y / p.w, 9.5f, 1e-3f);
    EXPECT_LT(projection.project(ray.origin - ray.direction).z, 0);
}

INSTANTIATE_TEST_SUITE_P(Methods, Inspected,
                         testing::Values(Case{"pt", Method::pt}, Case{"gpt", Method::gpt},
                                         Case{"gpr", Method::gpr}, Case{"pr", Method::pr},
                                         Case{"rooks", Method::pr, ShiftKind::half_vector, Pattern::rooks},
                                         Case{"reconnection", Method::pr, ShiftKind::reconnection},
                                         Case{"replay", Method::gpr, ShiftKind::replay},
                                         Case{"replay_reconnection", Method::gpr, ShiftKind::replay_reconnection}),
                         [](const auto& c) { return std::string(c.param.name); });

} // namespace

} // namespace tessera::test
