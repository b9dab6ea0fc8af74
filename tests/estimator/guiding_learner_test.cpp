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

/// Light that is found at a place that looks up, where all directions are drawn as often.
FoundLight light(glm::vec3 at, glm::vec3 direction, float value = 1) {
    return {at, up, direction, value, value, 1 / (4 * pi)};
}

Random numbers(int i) {
    return Random(1, static_cast<std::uint32_t>(i), 0);
}

/// Of an even sphere.
glm::vec3 direction(int i) {
    const glm::vec2 u = numbers(i).draw_2d(0, Draw::direction);
    const float z = 2 * u.x - 1, r = std::sqrt(1 - z * z);
    return {r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y), z};
}

} // namespace

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

TEST(GuidingLearner, DrawsAsManyAsPayAndNoneWhereNoneDo) {
    const glm::vec3 pays(0), costs(9, 0, 3), few(0.8f, 0, 0);
    GuidingLearner learner;
    std::vector<std::vector<FoundLight>> found(1);
    for (int i = 0; i < 400; ++i) {
        found[0].push_back(light(pays, up));
        found[0].push_back(light(costs, direction(i)));
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
        std::vector<std::vector<FoundLight>> found(1);
        for (int i = 0; i < 100; ++i) {
            found[0].push_back(light(pays, up));
            for (int k = 0; k < times; ++k)
                found[0].push_back(light(costs, direction(times * i + k)));
            if (i % 5 == 0) // rare, and so bright that it would have all to say by its squares
                found[0].push_back(light(bright, direction(-i), 1000));
        }
        learner.learn(found);
        const std::shared_ptr<const PathGuiding> guiding = learner.make_guiding(Guiding::where_it_pays);
        ASSERT_TRUE(guiding && guiding->known_at(pays, up)) << "it is gone on telling";
        EXPECT_LT(guiding->remaining_second_moment(), times == 1 ? 0.3 : 0.98);
        EXPECT_GT(guiding->remaining_second_moment(), times == 1 ? 0.05 : 0.9);
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
                                                    : direction(i);
            const float pdf_w = (1 - share) * even + (guide ? share * guide->map.pdf_w(d) : 0);
            const float value = brightness * even / pdf_w;
            found[0].push_back({here, up, d, value, value, pdf_w});
            if (!guide)
                found[0].push_back(light(there, direction(i)));
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
    EXPECT_NEAR(second->remaining_second_moment(), left, 0.3 * left) << "the guide is good as ever";
    const auto third = pass(second->at(here, up), From::everywhere, 1e3f);
    EXPECT_EQ(third->at(here, up), nullptr) << "and is no longer";
    const auto fourth = pass(third->at(here, up), From::above, 1e5f);
    ASSERT_TRUE(fourth->at(here, up)) << "and again, by paths that nothing has guided";
    EXPECT_EQ(fourth->at(here, up)->share, 0.75f);
}

TEST(GuidingLearner, LearnsOfTheFirstPassesMost) {
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

} // namespace tessera::test
