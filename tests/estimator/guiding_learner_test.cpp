// Guides learned from the samples of earlier passes: directions, shares, and the decision whether guiding pays.
#include "render/estimator/guiding_learner.h"
#include "render/run/render.h"
#include "render/run/thread_pool.h"
#include "render/sampling/sampling.h"
#include "tests/support/rooms.h"

#include <algorithm>
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

constexpr glm::vec3 up(0, 1, 0);

/// Returns a sample of a vertex with normal `up`, whose direction was drawn uniformly on the sphere.
FoundLight uniform_sample(glm::vec3 at, glm::vec3 direction, float value = 1) {
    return {at, up, direction, value, value, 1 / (4 * pi)};
}

Random numbers(int i) {
    return Random(1, static_cast<std::uint32_t>(i), 0);
}

/// Returns direction i of a uniform distribution on the sphere.
glm::vec3 direction(int i) {
    const glm::vec2 u = numbers(i).draw_2d(0, Draw::direction);
    const float z = 2 * u.x - 1, r = std::sqrt(1 - z * z);
    return {r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y), z};
}

} // namespace

TEST(GuidingLearner, GuidesTowardFoundLight) {
    GuidingLearner learner;
    EXPECT_EQ(learner.make_guiding(Guiding::on), nullptr);
    const glm::vec3 here(0), there(9, 0, 3), from = glm::normalize(glm::vec3(0.3f, 0.8f, -0.5f)),
                                             other = glm::normalize(glm::vec3(-0.3f, 0.8f, -0.5f));
    std::vector<std::vector<FoundLight>> found(2);
    for (int i = 0; i < 500; ++i) {
        found[0].push_back(uniform_sample(here, from));
        found[1].push_back(uniform_sample(there, other));
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

TEST(GuidingLearner, ChoosesTheBestShareOfEachCell) {
    // Cells where guiding pays, where it does not, and where there are few samples.
    const glm::vec3 pays(0), costs(9, 0, 3), few(0.8f, 0, 0);
    GuidingLearner learner;
    std::vector<std::vector<FoundLight>> found(1);
    for (int i = 0; i < 400; ++i) {
        found[0].push_back(uniform_sample(pays, up));
        found[0].push_back(uniform_sample(costs, direction(i)));
        if (i % 50 == 0) // a delta scatter: shares above 1/2 would sample it too rarely
            found[0].push_back({pays, up, up, 0, 0.32f, 0.5f});
        if (i < 6)
            found[0].push_back(uniform_sample(few, up));
    }
    found[0].push_back({pays, up, up, 1, 1e30f, 1 / (4 * pi)}); // its square overflows, so it is ignored
    learner.learn(found);
    const std::shared_ptr<const PathGuiding> guiding = learner.make_guiding(Guiding::on);
    ASSERT_TRUE(guiding && guiding->at(pays, up));
    EXPECT_TRUE(guiding->draws());
    EXPECT_EQ(guiding->at(pays, up)->share, 0.5f);
    EXPECT_EQ(guiding->at(costs, up), nullptr) << "guides must be tried on samples of the other half";
    ASSERT_TRUE(guiding->known_at(costs, up)) << "samples continue to estimate shares";
    EXPECT_EQ(guiding->known_at(costs, up)->share, 0);
    // With too few samples of its own, a cell takes the share of the coarser cell.
    ASSERT_NE(guiding->at(few, up), guiding->at(pays, up)) << "another cell";
    EXPECT_EQ(guiding->at(few, up)->share, 0.5f);
}

/// Guiding pays for light from above, and does not pay for uniform light. The second scene has more uniform light.
TEST(GuidingLearner, AutoDrawsOnlyIfItPaysInTheWholeScene) {
    const glm::vec3 pays(0), costs(9, 0, 3), bright(0, 0, 3);
    for (const int uniform_samples : {1, 60}) {
        GuidingLearner learner;
        std::vector<std::vector<FoundLight>> found(1);
        for (int i = 0; i < 100; ++i) {
            found[0].push_back(uniform_sample(pays, up));
            for (int k = 0; k < uniform_samples; ++k)
                found[0].push_back(uniform_sample(costs, direction(uniform_samples * i + k)));
            if (i % 5 == 0) // few and bright: they would dominate sums of squares
                found[0].push_back(uniform_sample(bright, direction(-i), 1000));
        }
        learner.learn(found);
        const std::shared_ptr<const PathGuiding> guiding = learner.make_guiding(Guiding::automatic);
        ASSERT_TRUE(guiding && guiding->known_at(pays, up)) << "samples continue to estimate shares";
        EXPECT_LT(guiding->remaining_second_moment(), uniform_samples == 1 ? 0.3 : 0.98);
        EXPECT_GT(guiding->remaining_second_moment(), uniform_samples == 1 ? 0.05 : 0.9);
        EXPECT_EQ(guiding->draws(), uniform_samples == 1);
        EXPECT_TRUE(learner.make_guiding(Guiding::on)->draws());
        EXPECT_EQ(guiding->at(pays, up) != nullptr, uniform_samples == 1);
        EXPECT_EQ(guiding->at(costs, up), nullptr);
    }
}

TEST(GuidingLearner, EstimatesWithTheGuideThatDrewThePaths) {
    GuidingLearner learner;
    const glm::vec3 here(0), there(9, 0, 3);
    enum class From { above, everywhere };
    const auto pass = [&](const DirectionGuide* guide, From from, float brightness) {
        std::vector<std::vector<FoundLight>> found(1);
        const float uniform_pdf = 1 / (4 * pi), share = guide ? guide->share : 0;
        for (int i = 0; i < 400; ++i) {
            const glm::vec2 u = numbers(i).draw_2d(0, Draw::direction);
            const float lobe = numbers(i).draw(0, Draw::lobe);
            const glm::vec3 d = from == From::above ? up
                                : lobe < share      ? guide->map.sample(lobe / share, u).direction
                                                    : direction(i);
            const float pdf_w = (1 - share) * uniform_pdf + (guide ? share * guide->map.pdf_w(d) : 0);
            const float value = brightness * uniform_pdf / pdf_w;
            found[0].push_back({here, up, d, value, value, pdf_w});
            if (!guide)
                found[0].push_back(uniform_sample(there, direction(i)));
        }
        learner.learn(found);
        return learner.make_guiding(Guiding::on);
    };
    const auto first = pass(nullptr, From::above, 1);
    const double left = first->remaining_second_moment();
    ASSERT_TRUE(first->at(here, up));
    EXPECT_EQ(first->at(here, up)->share, 0.75f);
    const auto second = pass(first->at(here, up), From::above, 100);
    ASSERT_TRUE(second->at(here, up));
    EXPECT_EQ(second->at(here, up)->share, 0.75f);
    EXPECT_NEAR(second->remaining_second_moment(), left, 0.3 * left)
        << "the guide is as good as in the first pass";
    const auto third = pass(second->at(here, up), From::everywhere, 1e3f);
    EXPECT_EQ(third->at(here, up), nullptr) << "light comes from everywhere: guiding does not pay";
    const auto fourth = pass(third->at(here, up), From::above, 1e5f);
    ASSERT_TRUE(fourth->at(here, up)) << "unguided paths find light from above: guiding pays";
    EXPECT_EQ(fourth->at(here, up)->share, 0.75f);
}

TEST(GuidingLearner, FractionOfGuidingPathsFallsWithPasses) {
    const auto paths = [](int pixels, int index, bool draws) {
        return pixels * static_cast<double>(GuidingLearner::fraction_of_paths(pixels, index, draws));
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

/// A room under a lamp, and one under a lamp that faces up, so that all light comes from a patch of the ceiling.
/// Guiding pays in the second one only.
TEST(PathGuiding, AutoGuidesOnlyWhereItPays) {
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
        if (is_hidden) // faces up
            b.quad({-0.05f, y, -0.05f}, {0, 0, 0.1f}, {0.1f, 0, 0}, wall, lamp);
        else
            b.quad({-0.05f, y, -0.05f}, {0.1f, 0, 0}, {0, 0, 0.1f}, wall, lamp);
        b.camera({0, 0, 2.6f}, {0, -0.9f, -0.6f}, 16);
        const auto scene = b.build();
        const RgbImage automatic = picture(scene, Guiding::automatic);
        EXPECT_EQ(same(automatic, picture(scene, Guiding::on)), is_hidden);
        EXPECT_EQ(same(automatic, picture(scene, Guiding::off)), !is_hidden);
    }
}

} // namespace tessera::test
