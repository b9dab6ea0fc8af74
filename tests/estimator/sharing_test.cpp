// Conditions of the balance heuristic, theory (12): the weights of a light path and its contributions to all
// pixels do not depend on the pixel of the sampling set that made it.
//
// A light path of pixel k is shifted to pixel m, as a path that m could have traced itself
// (tests/support/shifted_path.h), and reused from there. With weights w_k = 1 / R_k,
//   sum over the pixels n that can make the light path of  w_n = 1,
// and every pixel gets the same radiance from each of them. For two pixels this is r_km r_mk = 1: the shift and
// its Jacobian invert themselves. jacobian_test.cpp finds Jacobians that are wrong and still invert themselves.
#include "render/estimator/path_reuse.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"
#include "tests/support/shifted_path.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(48, 36);
constexpr int set_edge = 3; // pixels

struct Tally {
    int shared = 0;  ///< light paths that more than one pixel could have made
    int lost = 0;    ///< of these: shifted() fails to a pixel that gets radiance
    int unequal = 0; ///< contributions depend on the pixel, or weights do not sum to one
    int wrong = 0;   ///< of these: by more than the rounding of short edges explains
    int astray = 0;  ///< the shift there and back ends at other vertices
};

class WorkDivision {
public:
    WorkDivision(const TestScene& t, ShiftSettings settings, int roulette_depth, TextureFilter filter,
                 bool unfiltered_first = false)
        : scene_(*t.scene), settings_(settings), tracer_{scene_,
                                                         counters_,
                                                         {t.max_depth, roulette_depth, filter},
                                                         {filter, unfiltered_first, scene_.camera(), size}},
          reuse_(tracer_, settings_) {}

    Tally run(int sets) {
        for (int i = 0; i < sets; ++i)
            share_all(paths_of(i));
        return tally_;
    }

    /// Radiance of all pixels of all sets, and the rays of the offset paths.
    struct Reused {
        std::vector<Rgb> radiance;
        std::uint64_t rays = 0;
    };
    /// @param begins_each_path  calls PathReuse::begin() before each path; else once per set
    Reused share_sets(int sets, bool begins_each_path) {
        Reused result;
        const std::uint64_t before = counters_.rays[static_cast<std::size_t>(RayKind::shift_bounce)];
        for (int i = 0; i < sets; ++i) {
            const std::vector<BasePath> paths = paths_of(i);
            const Set set = set_of(paths);
            std::vector<Rgb> radiance(set.size(), Rgb(0));
            for (std::size_t k = 0; k < set.size(); ++k) {
                if (k == 0 || begins_each_path)
                    reuse_.begin(set, ones_);
                reuse_.share(static_cast<int>(k), 1, radiance);
            }
            result.radiance.insert(result.radiance.end(), radiance.begin(), radiance.end());
        }
        result.rays = counters_.rays[static_cast<std::size_t>(RayKind::shift_bounce)] - before;
        return result;
    }

private:
    using Set = std::vector<const BasePath*>;

    std::vector<BasePath> paths_of(int set) {
        const Random random(5, static_cast<std::uint32_t>(set), 0);
        const glm::ivec2 corner(random.draw_2d(0, Draw::direction) * glm::vec2(size - set_edge));
        const Projection projection(scene_.camera(), size);
        const glm::vec2 inside = random.draw_2d(1, Draw::direction);
        std::vector<BasePath> paths(static_cast<std::size_t>(set_edge * set_edge));
        for (int i = 0; i < set_edge * set_edge; ++i) {
            BasePath& path = paths[static_cast<std::size_t>(i)];
            const glm::ivec2 pixel = corner + glm::ivec2(i % set_edge, i / set_edge);
            const auto number = static_cast<std::uint32_t>(random.draw(i, Draw::lobe) * 0x1p24f);
            trace_base_path(tracer_, projection.ray(glm::vec2(pixel) + inside), projection.pixel_width(),
                            Random(9, number, 1), path);
        }
        return paths;
    }

    static Set set_of(const std::vector<BasePath>& paths) {
        Set set;
        for (const BasePath& path : paths)
            set.push_back(&path);
        return set;
    }

    void share_all(const std::vector<BasePath>& paths) {
        const Set set = set_of(paths);
        for (std::size_t k = 0; k < set.size(); ++k) {
            LightPaths light;
            light.reset(*set[k], settings_);
            for (int slot = light.first_shared(); slot < light.slot_count(); ++slot)
                if (light.is_alive(slot) && luminance(light.carried(slot)) > 1e-20f)
                    test_light_path(set, k, slot, light.carried(slot));
        }
    }

    /// Returns what each pixel gets from `path` as the path of pixel k.
    std::vector<Rgb> share(Set set, std::size_t k, const BasePath& path) {
        set[k] = &path;
        std::vector<Rgb> radiance(set.size(), Rgb(0));
        reuse_.begin(set, ones_);
        reuse_.share(static_cast<int>(k), 1, radiance);
        return radiance;
    }

    void test_light_path(const Set& set, std::size_t k, int slot, Rgb carried) {
        const BasePath one = isolated(*set[k], settings_, slot);
        const std::vector<Rgb> from_k = share(set, k, one);
        double weights = luminance(from_k[k]) / double(luminance(carried));
        double worst = 0;
        bool is_shared = false, is_astray = false;
        for (std::size_t m = 0; m < set.size(); ++m) {
            if (m == k || is_black(from_k[m]))
                continue;
            is_shared = true;
            const auto there = shifted(tracer_, settings_, one, slot, *set[m]);
            if (!there) {
                ++tally_.lost;
                return;
            }
            LightPaths light;
            light.reset(*there, settings_);
            const std::vector<Rgb> from_m = share(set, m, *there);
            const auto back = shifted(tracer_, settings_, *there, slot, one);
            is_astray = is_astray || !back || !has_vertices_of(*back, one);
            weights += luminance(from_m[m]) / double(luminance(light.carried(slot)));
            for (std::size_t n = 0; n < set.size(); ++n) {
                const double scale = luminance(from_k[n]) + luminance(from_m[n]);
                if (scale > 0)
                    worst = std::max(worst, std::abs(luminance(from_k[n] - from_m[n])) / scale);
            }
        }
        tally_.shared += is_shared;
        if (!is_shared)
            return;
        worst = std::max(worst, std::abs(weights - 1));
        tally_.unequal += !(worst < 1e-3);
        tally_.wrong += !(worst < 0.05);
        tally_.astray += is_astray;
    }

    /// Returns whether the vertices of `path` are the first vertices of `other`.
    static bool has_vertices_of(const BasePath& path, const BasePath& other) {
        if (path.size() > other.size())
            return false;
        for (int i = 0; i < path.size(); ++i)
            if (!(glm::distance(path[i].vertex.position, other[i].vertex.position) < 1e-3f))
                return false;
        return true;
    }

    const Scene& scene_;
    Counters counters_;
    ShiftSettings settings_;
    Tracer tracer_;
    PathReuse reuse_;
    const std::vector<float> ones_ = std::vector<float>(most_lanes, 1);
    Tally tally_;
};

class ReuseWeights : public testing::TestWithParam<TestScene> {
protected:
    /// The tolerances allow for rounding: of the lengths of short edges in corners, of directions in narrow lobes,
    /// and of rays at the borders of triangles.
    static void expect_consistent_reuse(ShiftSettings s, int roulette_depth,
                                        TextureFilter filter = TextureFilter::off) {
        s.shift_threshold = GetParam().shift_threshold;
        SCOPED_TRACE("shift kind " + std::to_string(static_cast<int>(s.shift)) + ", distance " +
                     std::to_string(s.shift_distance));
        const Tally t = WorkDivision(GetParam(), s, roulette_depth, filter).run(40);
        EXPECT_EQ(t.lost, 0);
        EXPECT_LE(t.unequal, 0.04 * t.shared);
        EXPECT_LE(t.wrong, 0.001 * t.shared);
        EXPECT_LE(t.astray, 0.001 * t.shared);
        const bool has_any = GetParam().max_depth > 1 && GetParam().name != "no_light";
        if (s.shift != ShiftKind::reconnection && has_any) {
            EXPECT_GT(t.shared, 200); // enough to test
        }
    }
};

TEST_P(ReuseWeights, AreIndependentOfTheBasePixel) {
    for (const ShiftKind kind :
         {ShiftKind::half_vector, ShiftKind::reconnection, ShiftKind::replay, ShiftKind::replay_reconnection}) {
        expect_consistent_reuse({kind, 0, 0}, 0);
        expect_consistent_reuse({kind, 0, GetParam().shift_distance}, 2);
        expect_consistent_reuse({kind, 0, GetParam().shift_distance}, 0, TextureFilter::path);
    }
}

/// PathReuse caches what a delta scatter at x_1 meets, for all base paths of a set. The cache must not change the
/// result.
TEST_P(ReuseWeights, AreEqualWithAndWithoutTheCacheOfASet) {
    for (const ShiftKind kind :
         {ShiftKind::half_vector, ShiftKind::reconnection, ShiftKind::replay, ShiftKind::replay_reconnection}) {
        const ShiftSettings s{kind, GetParam().shift_threshold, GetParam().shift_distance};
        WorkDivision sharing(GetParam(), s, 0, TextureFilter::path);
        const auto cached = sharing.share_sets(40, false), uncached = sharing.share_sets(40, true);
        EXPECT_TRUE(cached.radiance == uncached.radiance) << static_cast<int>(kind);
        EXPECT_LE(cached.rays, uncached.rays);
        if (kind == ShiftKind::half_vector && GetParam().name == "mirror") {
            EXPECT_LT(cached.rays, uncached.rays); // the cache is used
        }
    }
}

/// Returns all scenes without masks. A mask lets rays through at random, and differently for rays that differ by
/// rounding.
std::vector<TestScene> scenes_without_masks() {
    std::vector<TestScene> scenes = all_test_scenes();
    std::erase_if(scenes, [](const TestScene& t) { return t.name.starts_with("masks"); });
    return scenes;
}

INSTANTIATE_TEST_SUITE_P(scenes, ReuseWeights, testing::ValuesIn(scenes_without_masks()),
                         [](const auto& p) { return p.param.name; });

/// A fine checkerboard between two mirrors that face each other. PathReuse caches what is behind the first mirror;
/// offset paths trace what is behind further mirrors.
TEST(ReuseWeightsInMirrors, AreIndependentOfTheBasePixelWithAnyFilter) {
    SceneBuilder b;
    b.quad({1, -2, 0}, {0, 4, 0}, {0, 0, -9}, b.mirror());
    b.quad({-1, -2, -9}, {0, 4, 0}, {0, 0, 9}, b.mirror());
    DiffuseMaterial checker;
    checker.reflectance.kind = CheckerboardTexture{Rgb(0.9f, 0.2f, 0.1f), Rgb(0.1f, 0.3f, 0.8f)};
    checker.reflectance.to_uv = glm::mat3(60, 0, 0, 0, 200, 0, 0, 0, 1);
    b.quad({-1, -1, 0}, {2, 0, 0}, {0, 0, -9}, b.material({"checker", checker}));
    b.quad({-1, 2, -9}, {2, 0, 0}, {0, 0, 9}, b.diffuse(Rgb(0.5f)), b.light(Rgb(3)));
    b.camera({0, 0.5f, -0.5f}, {1, 0.1f, -1.5f}, 40);
    const TestScene scene{"beyond_mirrors", b.build(), 7};
    for (const ShiftKind kind : {ShiftKind::half_vector, ShiftKind::replay, ShiftKind::replay_reconnection})
        for (const TextureFilter filter : {TextureFilter::camera, TextureFilter::path})
            for (const bool unfiltered_first : {false, true}) {
                const Tally t = WorkDivision(scene, {kind, 0.001f, 0}, 0, filter, unfiltered_first).run(60);
                EXPECT_GT(t.shared, 200);
                EXPECT_EQ(t.lost, 0);
                EXPECT_LE(t.unequal, 0.04 * t.shared)
                    << static_cast<int>(kind) << ", unfiltered x_1 " << unfiltered_first;
                EXPECT_LE(t.wrong, 0.001 * t.shared)
                    << static_cast<int>(kind) << ", unfiltered x_1 " << unfiltered_first;
            }
}

TEST(PathReuse, RejectsASetWithMorePixelsThanLanes) {
    const auto scene = all_test_scenes().front().scene;
    Counters counters;
    const Tracer tracer{*scene, counters, {}};
    const ShiftSettings settings;
    PathReuse reuse(tracer, settings);
    const BasePath path;
    const std::vector<const BasePath*> most(most_lanes, &path), too_many(most_lanes + 1, &path);
    EXPECT_NO_THROW(reuse.begin(most, {}));
    EXPECT_THROW(reuse.begin(too_many, {}), std::logic_error);
}

} // namespace

} // namespace tessera::test
