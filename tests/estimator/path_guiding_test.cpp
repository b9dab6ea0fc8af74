#include "render/estimator/guiding_learner.h"
#include "render/estimator/offsets.h"
#include "render/run/render.h"
#include "render/run/thread_pool.h"
#include "tests/support/rooms.h"
#include "tests/surface/bsdf_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Uneven, with empty bins and one that has nearly all.
DirectionMap::Shares uneven_shares() {
    DirectionMap::Shares shares{};
    float sum = 0;
    for (std::size_t b = 0; b < shares.size(); ++b) {
        shares[b] = b % 3 == 0 ? 0 : static_cast<float>(b % 7);
        shares[b] += b == 100 ? 3000 : 0;
        sum += shares[b];
    }
    for (float& share : shares)
        share /= sum;
    return shares;
}

glm::vec3 on_sphere(float z, float phi) {
    const float r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

glm::vec3 on_sphere(glm::vec2 u) {
    return on_sphere(2 * u.x - 1, 2 * pi * u.y);
}

constexpr glm::vec3 up(0, 1, 0);

/// Light that is found at a place that looks up, where all directions are drawn as often.
FoundLight light(glm::vec3 at, glm::vec3 direction, float value = 1) {
    return {at, up, direction, value, value, 1 / (4 * pi)};
}

Random numbers(int i) {
    return Random(1, static_cast<std::uint32_t>(i), 0);
}

} // namespace

TEST(DirectionMap, PdfIntegratesToOneOverTheSphere) {
    const DirectionMap map(uneven_shares());
    constexpr int rings = 1000, steps = 2000;
    double sum = 0;
    for (int ring = 0; ring < rings; ++ring)
        for (int step = 0; step < steps; ++step) {
            const float z = 2 * (static_cast<float>(ring) + 0.5f) / rings - 1;
            const float phi = 2 * pi * (static_cast<float>(step) + 0.5f) / steps;
            sum += static_cast<double>(map.pdf_w(on_sphere(z, phi)));
        }
    EXPECT_NEAR(sum * 4 * static_cast<double>(pi) / (rings * steps), 1, 2e-3);
}

TEST(DirectionMap, SamplesComeAsOftenAsTheirSharesSayAndKnowTheirPdf) {
    const DirectionMap::Shares shares = uneven_shares();
    const DirectionMap map(shares);
    constexpr int samples = 400000;
    std::vector<int> counts(DirectionMap::bins);
    int moved = 0;
    for (int i = 0; i < samples; ++i) {
        const DirectionMap::Sample s =
            map.sample(numbers(i).draw(0, Draw::lobe), numbers(i).draw_2d(0, Draw::direction));
        EXPECT_NEAR(glm::length(s.direction), 1, 1e-5);
        EXPECT_GT(s.pdf_w, 0);
        const int bin = DirectionMap::bin_of(s.direction);
        ++counts[static_cast<std::size_t>(bin)];
        moved += std::abs(map.pdf_w(s.direction) - s.pdf_w) > 1e-3f * s.pdf_w;
    }
    EXPECT_LE(moved, samples / 10000); // at a bin's edge, rounding may move one to the next bin
    for (std::size_t b = 0; b < counts.size(); ++b) {
        const double expected = samples * static_cast<double>(shares[b]);
        EXPECT_NEAR(counts[b], expected, 5 * std::sqrt(expected) + 30) << b;
    }
}

/// What a vertex draws, by the pdf that it gives each direction: with every share of a guide the BSDF integrates
/// to the same, and all who ask for a pdf are told the one that directions are drawn by.
TEST(GuidedVertex, DrawsAsItSaysAndMissesNothing) {
    const auto diffuse = shared(DiffuseMaterial{Texture(Rgb(0.7f))}), mirror = shared(copper(0));
    const Bsdf bsdfs[] = {resolved(DiffuseMaterial{Texture(Rgb(0.7f))}), resolved(copper(0.3f)),
                          resolved(blend(diffuse, mirror, 0.4f))};
    constexpr int samples = 400000;
    const DirectionMap map(uneven_shares());
    for (const Bsdf& bsdf : bsdfs) {
        double unguided = 0;
        for (const float share : tried_shares) {
            const DirectionGuide guide{map, share};
            Vertex x;
            x.frame = Frame(glm::normalize(glm::vec3(0.3f, 0.5f, 0.8f)));
            x.bsdf = bsdf;
            x.to_previous = glm::normalize(glm::vec3(0.4f, -0.2f, 0.9f));
            x.guide = share > 0 ? &guide : nullptr;
            double sum = 0;
            int moved = 0;
            for (int i = 0; i < samples; ++i) {
                const auto s = x.sample(numbers(i).draw(0, Draw::lobe), numbers(i).draw_2d(0, Draw::direction));
                if (!s)
                    continue;
                sum += static_cast<double>(s->f_cos.g / s->pdf_w) / samples;
                const float told =
                    s->is_delta ? x.evaluate_delta(s->scatter).probability : x.evaluate(s->to_next).pdf_w;
                moved += std::abs(told - s->pdf_w) > 2e-3f * s->pdf_w;
            }
            EXPECT_LE(moved, samples / 1000) << share; // at a bin's edge, rounding may move one to the next bin
            unguided = share > 0 ? unguided : sum;
            EXPECT_NEAR(sum / unguided, 1, 0.01) << share;

            OffsetVertices y;
            y.reset(1);
            y.set(0, x);
            const glm::vec3 to_next = glm::normalize(glm::vec3(-0.2f, 0.4f, 0.7f));
            Vec3Lanes direction, from;
            direction.set(0, x.to_world(to_next));
            from.set(0, x.to_previous);
            LaneMask asked;
            asked[0] = -1;
            BsdfLanes as_offset, from_elsewhere;
            y.evaluate(direction, asked, as_offset);
            evaluate(x, from, to_next, asked, 1, from_elsewhere);
            const float pdf_w = x.evaluate(to_next).pdf_w;
            EXPECT_NEAR(as_offset.pdf_w[0] / pdf_w, 1, 1e-4) << share;
            EXPECT_NEAR(from_elsewhere.pdf_w[0] / pdf_w, 1, 1e-4) << share;
        }
    }
}

TEST(TriedShares, OfDeltaScattersGrowAsTheyAreDrawnLessOften) {
    const float chance = 0.4f, used = 0.5f;
    const TriedShares squares = squares_by_share(3, (1 - used) * chance, 0, used);
    // A value is 3 (1 - used) / (1 - share), and as much less often drawn.
    for (std::size_t s = 0; s < tried_shares.size(); ++s)
        EXPECT_NEAR(squares[s], 9 * (1 - used) / (1 - tried_shares[s]), 1e-4) << tried_shares[s];
}

TEST(GuidingLearner, DrawsFromWhereLightWasFoundAndOnlyThere) {
    GuidingLearner learner;
    EXPECT_EQ(learner.make_guiding(Guiding::on), nullptr);
    const glm::vec3 here(0), there(9, 0, 3), from = glm::normalize(glm::vec3(0.3f, 0.8f, -0.5f)),
                                             other = glm::normalize(glm::vec3(-0.3f, 0.8f, -0.5f));
    std::vector<std::vector<FoundLight>> found(2);
    for (int i = 0; i < 500; ++i) {
        found[0].push_back(light(here, from));
        found[1].push_back(light(there, other));
    }
    learner.learn(found);
    const std::shared_ptr<const PathGuiding> guiding = learner.make_guiding(Guiding::on);
    ASSERT_TRUE(guiding);
    const DirectionGuide *at_here = guiding->at(here, up), *at_there = guiding->at(there, up);
    ASSERT_TRUE(at_here && at_there);
    EXPECT_GT(at_here->map.pdf_w(from), 10 * at_here->map.pdf_w(other));
    EXPECT_GT(at_there->map.pdf_w(other), 10 * at_there->map.pdf_w(from));
    EXPECT_EQ(guiding->at(here, -up), nullptr);
}

TEST(TriedShares, TellTheSecondMomentsOfOtherShares) {
    const DirectionMap map(uneven_shares());
    const auto pdf_with = [&](float share, glm::vec3 d) { return (1 - share) / (4 * pi) + share * map.pdf_w(d); };
    const auto found_at = [](glm::vec3 d) { return 0.2f + std::max(d.z, 0.0f) * std::max(d.x, 0.0f); };
    const auto drawn_with = [&](float share, int i) {
        const Random random = numbers(i);
        const float lobe = random.draw(0, Draw::lobe);
        const glm::vec2 u = random.draw_2d(0, Draw::direction);
        return lobe < share ? map.sample(lobe / share, u).direction : on_sphere(u);
    };
    constexpr int samples = 200000;
    for (const float used : {0.0f, 0.5f, 0.75f}) {
        std::array<double, tried_shares.size()> told{};
        for (int i = 0; i < samples; ++i) {
            const glm::vec3 d = drawn_with(used, i);
            const float pdf_w = pdf_with(used, d);
            const TriedShares squares = squares_by_share(found_at(d) / pdf_w, pdf_w, map.pdf_w(d), used);
            for (std::size_t s = 0; s < squares.size(); ++s)
                told[s] += static_cast<double>(squares[s]) / samples;
        }
        for (std::size_t s = 0; s < tried_shares.size(); ++s) {
            double moment = 0;
            for (int i = 0; i < samples; ++i) {
                const glm::vec3 d = drawn_with(tried_shares[s], samples + i);
                moment += std::pow(static_cast<double>(found_at(d) / pdf_with(tried_shares[s], d)), 2) / samples;
            }
            EXPECT_NEAR(told[s] / moment, 1, 0.05) << "share " << tried_shares[s] << " by " << used;
        }
    }
}

/// Where half of the light goes on as in a mirror, guided directions take paths away from that.
TEST(PathGuiding, LeavesMirrorsBesideRoughLobesTheirPaths) {
    SceneBuilder b;
    const int wall = b.diffuse(white), half = b.blend(wall, b.mirror(), 0.5f), lamp = b.light(Rgb(5, 4, 3));
    b.room({half, wall, half, wall, wall});
    b.quad({-0.3f, 0.98f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}, wall, lamp);
    b.camera({0, 0, 2.6f}, {0, 0, 0}, 50);
    const auto scene = b.build();
    ThreadPool pool(1);
    double variance[2] = {};
    for (const bool is_guided : {false, true}) {
        RenderSettings settings;
        settings.method = Method::pt;
        settings.max_depth = 6;
        settings.very_direct_grid = 1;
        settings.path_guiding = is_guided ? Guiding::on : Guiding::off;
        Render render(scene, scene->camera(), {96, 72}, settings);
        for (int i = 0; i < 32; ++i)
            render.pass(pool);
        for (const float v : render.images().primal_variance)
            variance[is_guided] += static_cast<double>(v);
    }
    EXPECT_LT(variance[1], 1.2 * variance[0]);
}

/// A room that a lamp lights, or one that looks up, so that all comes from a patch of the ceiling.
TEST(PathGuiding, IsThereByItselfWhereItPaysAndElsewhereChangesNothing) {
    const auto picture = [](const std::shared_ptr<const Scene>& scene, Guiding when) {
        RenderSettings settings;
        settings.method = Method::pt;
        settings.path_guiding = when;
        ThreadPool pool(2);
        Render render(scene, scene->camera(), {160, 120}, settings);
        for (int i = 0; i < 5; ++i)
            render.pass(pool);
        return render.images().primal;
    };
    const auto same = [](const RgbImage& a, const RgbImage& b) { return std::ranges::equal(a, b); };
    for (const bool is_hidden : {false, true}) {
        SceneBuilder b;
        const int wall = b.diffuse(white), lamp = b.light(Rgb(50, 40, 30));
        b.room({wall, wall, wall, wall, wall});
        const float y = is_hidden ? 0.75f : 0.98f;
        if (is_hidden) // it looks up
            b.quad({-0.05f, y, -0.05f}, {0, 0, 0.1f}, {0.1f, 0, 0}, wall, lamp);
        else
            b.quad({-0.05f, y, -0.05f}, {0.1f, 0, 0}, {0, 0, 0.1f}, wall, lamp);
        b.camera({0, 0, 2.6f}, {0, -0.9f, -0.6f}, 16);
        const auto scene = b.build();
        const RgbImage by_itself = picture(scene, Guiding::where_it_pays);
        EXPECT_EQ(same(by_itself, picture(scene, Guiding::on)), is_hidden);
        EXPECT_EQ(same(by_itself, picture(scene, Guiding::off)), !is_hidden);
    }
}

TEST(GuidingLearner, DrawsAsManyAsPayAndNoneWhereNoneDo) {
    const glm::vec3 pays(0), costs(9, 0, 3), few(0.8f, 0, 0);
    GuidingLearner learner;
    std::vector<std::vector<FoundLight>> found(1);
    for (int i = 0; i < 400; ++i) {
        found[0].push_back(light(pays, up));
        found[0].push_back(light(costs, on_sphere(numbers(i).draw_2d(0, Draw::direction))));
        if (i % 50 == 0) // a mirror's, of which more than half of the directions would take away too many
            found[0].push_back({pays, up, up, 0, 0.32f, 0.5f});
        if (i < 6)
            found[0].push_back(light(few, up));
    }
    found[0].push_back({pays, up, up, 1, 1e30f, 1 / (4 * pi)}); // its square is no number, and tells nothing
    learner.learn(found);
    const std::shared_ptr<const PathGuiding> guiding = learner.make_guiding(Guiding::on);
    ASSERT_TRUE(guiding && guiding->at(pays, up));
    EXPECT_TRUE(guiding->draws());
    EXPECT_EQ(guiding->at(pays, up)->share, 0.5f);
    EXPECT_EQ(guiding->at(costs, up), nullptr) << "a guide that its own samples are told by would seem to pay";
    ASSERT_TRUE(guiding->known_at(costs, up)) << "it is gone on telling";
    EXPECT_EQ(guiding->known_at(costs, up)->share, 0);
    // Too few samples of its own: what is known of all around.
    ASSERT_NE(guiding->at(few, up), guiding->at(pays, up)) << "another cell";
    EXPECT_EQ(guiding->at(few, up)->share, 0.5f);
}

/// Light from everywhere finds no use in a guide, and light from above nearly all.
TEST(GuidingLearner, DrawsInAWholeSceneWhereItPays) {
    const glm::vec3 pays(0), costs(9, 0, 3), bright(0, 0, 3);
    for (const int times : {1, 60}) {
        GuidingLearner learner;
        EXPECT_EQ(learner.left_of_squares(), 1);
        std::vector<std::vector<FoundLight>> found(1);
        for (int i = 0; i < 100; ++i) {
            found[0].push_back(light(pays, up));
            for (int k = 0; k < times; ++k)
                found[0].push_back(light(costs, on_sphere(numbers(times * i + k).draw_2d(0, Draw::direction))));
            if (i % 5 == 0) // rare, and so bright that it would have all to say by its squares
                found[0].push_back(light(bright, on_sphere(numbers(-i).draw_2d(0, Draw::direction)), 1000));
        }
        learner.learn(found);
        EXPECT_LT(learner.left_of_squares(), times == 1 ? 0.3 : 0.98);
        EXPECT_GT(learner.left_of_squares(), times == 1 ? 0.05 : 0.9);
        const std::shared_ptr<const PathGuiding> guiding = learner.make_guiding(Guiding::where_it_pays);
        ASSERT_TRUE(guiding && guiding->known_at(pays, up)) << "it is gone on telling";
        EXPECT_EQ(guiding->draws(), times == 1);
        EXPECT_TRUE(learner.make_guiding(Guiding::on)->draws());
        EXPECT_EQ(guiding->at(pays, up) != nullptr, times == 1);
        EXPECT_EQ(guiding->at(costs, up), nullptr);
    }
}

/// What paths tell is by the guide that they were drawn with, whatever that draws.
TEST(GuidingLearner, TellsByTheGuideThatPathsWereDrawnWith) {
    GuidingLearner learner;
    const glm::vec3 here(0), there(9, 0, 3);
    enum class From { above, everywhere };
    const auto pass = [&](const DirectionGuide* guide, From from, float brightness) {
        std::vector<std::vector<FoundLight>> found(1);
        const float even = 1 / (4 * pi), share = guide ? guide->share : 0;
        for (int i = 0; i < 400; ++i) {
            const glm::vec2 u = numbers(i).draw_2d(0, Draw::direction);
            const float lobe = numbers(i).draw(0, Draw::lobe);
            const glm::vec3 d = from == From::above ? up
                                : lobe < share      ? guide->map.sample(lobe / share, u).direction
                                                    : on_sphere(u);
            const float pdf_w = (1 - share) * even + (guide ? share * guide->map.pdf_w(d) : 0);
            const float value = brightness * even / pdf_w;
            found[0].push_back({here, up, d, value, value, pdf_w});
            if (!guide)
                found[0].push_back(light(there, on_sphere(u)));
        }
        learner.learn(found);
        return learner.make_guiding(Guiding::on);
    };
    const auto first = pass(nullptr, From::above, 1);
    const double left = learner.left_of_squares();
    ASSERT_TRUE(first->at(here, up));
    EXPECT_EQ(first->at(here, up)->share, 0.75f);
    const auto second = pass(first->at(here, up), From::above, 100);
    ASSERT_TRUE(second->at(here, up));
    EXPECT_EQ(second->at(here, up)->share, 0.75f);
    EXPECT_NEAR(learner.left_of_squares(), left, 0.3 * left) << "the guide is good as ever";
    const auto third = pass(second->at(here, up), From::everywhere, 1e3f);
    EXPECT_EQ(third->at(here, up), nullptr) << "and is no longer";
    const auto fourth = pass(third->at(here, up), From::above, 1e5f);
    ASSERT_TRUE(fourth->at(here, up)) << "and again, by paths that nothing has guided";
    EXPECT_EQ(fourth->at(here, up)->share, 0.75f);
}

TEST(GuidingLearner, LearnsOfTheFirstPassesMost) {
    const auto paths = [](int pixels, int index, bool draws) {
        return pixels * static_cast<double>(GuidingLearner::share_of_paths(pixels, index, draws));
    };
    EXPECT_EQ(paths(1000, 0, false), 1000);
    EXPECT_EQ(paths(1000, 7, true), 1000);
    EXPECT_EQ(paths(1000, 7, false), 250);
    constexpr int pixels = 1 << 20;
    double drawn = 0, undrawn = 0;
    for (int index = 16; index < 32; ++index) {
        drawn += paths(pixels, index, true);
        undrawn += paths(pixels, index, false);
    }
    EXPECT_NEAR(paths(pixels, 0, false), 1 << 16, 1);
    EXPECT_NEAR(paths(pixels, 1, true), 1 << 18, 1);
    EXPECT_NEAR(drawn, 1 << 18, 16);
    EXPECT_NEAR(undrawn, 1 << 16, 16);
    EXPECT_NEAR(paths(pixels, 1 << 20, true), 1 << 10, 1);
}

} // namespace tessera::test
