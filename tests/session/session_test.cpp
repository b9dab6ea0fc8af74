// What the viewer relies on: the newest request wins, nothing of an old one comes back, pausing publishes.
#include "render/session/session.h"
#include "tests/support/scene_builder.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

using namespace std::chrono_literals;

std::shared_ptr<const Scene> scene() {
    static const std::shared_ptr<const Scene> s = all_test_scenes().front().scene;
    return s;
}

RenderRequest request(Method method, glm::ivec2 size = {48, 32}, int spp_limit = 0) {
    RenderSettings settings;
    settings.method = method;
    settings.max_depth = 4;
    return {scene(), scene()->camera(), size, settings, spp_limit};
}

bool eventually(const std::function<bool()>& holds) {
    for (int i = 0; i < 4000; ++i) {
        if (holds())
            return true;
        std::this_thread::sleep_for(5ms);
    }
    return false;
}

TEST(Session, PublishesACoarsePictureFirstAndReconstructs) {
    std::atomic<int> published = 0;
    Session session(1, 2, [&] { ++published; });
    const std::uint64_t generation = session.submit(0, request(Method::gpr, {200, 120}, 2));
    ASSERT_TRUE(eventually([&] { return session.latest(0) != nullptr; }));
    const auto first = session.latest(0);
    EXPECT_EQ(first->generation, generation);
    EXPECT_TRUE(first->coarse);
    EXPECT_EQ(first->images->primal.width(), 50);
    ASSERT_TRUE(eventually([&] {
        const auto s = session.latest(0);
        return s->spp == 2 && s->reconstruction_spp == 2;
    }));
    const auto last = session.latest(0);
    EXPECT_FALSE(last->coarse);
    EXPECT_EQ(last->images->primal.width(), 200);
    EXPECT_EQ(last->reconstruction->image.width(), 200);
    EXPECT_GE(published, 3);
}

TEST(Session, NewestRequestWinsInAStorm) {
    Session session(2, 2);
    std::uint64_t newest = 0;
    for (int i = 0; i < 200; ++i) {
        RenderRequest r = request(all_methods[i % 4], {40 + i % 7, 30}, 1);
        r.settings.seed = static_cast<std::uint64_t>(i);
        newest = session.submit(i % 2, r);
        if (i % 3 == 0)
            session.set_reconstruction(i % 2, {i % 2 ? Norm::l2 : Norm::l1, 0.2f});
        if (const auto s = session.latest(i % 2)) {
            EXPECT_LE(s->generation, newest);
        }
    }
    ASSERT_TRUE(eventually([&] {
        const auto s = session.latest(1);
        return s && s->generation == newest && !s->coarse;
    }));
    EXPECT_EQ(session.latest(1)->settings.seed, 199u);
    EXPECT_TRUE(session.take_messages().empty());
}

TEST(Session, PausePublishesAndStops) {
    Session session(1, 2);
    session.submit(0, request(Method::pt));
    ASSERT_TRUE(eventually([&] { return session.latest(0) && session.latest(0)->spp > 3; }));
    session.set_paused(true);
    std::this_thread::sleep_for(300ms);
    const int spp = session.latest(0)->spp;
    std::this_thread::sleep_for(300ms);
    EXPECT_EQ(session.latest(0)->spp, spp);
    session.set_paused(false);
    EXPECT_TRUE(eventually([&] { return session.latest(0)->spp > spp; }));
}

TEST(Session, PanesShareTheTime) {
    Session session(2, 2);
    session.submit(0, request(Method::pt, {96, 64}));
    session.submit(1, request(Method::gpr, {96, 64}));
    ASSERT_TRUE(eventually([&] {
        const auto a = session.latest(0), b = session.latest(1);
        return a && b && a->seconds > 0.5 && b->seconds > 0.5;
    }));
    session.set_paused(true);
    std::this_thread::sleep_for(300ms);
    EXPECT_NEAR(session.latest(0)->seconds, session.latest(1)->seconds, 0.25);
}

TEST(Session, BadSettingsGiveAMessageAndTheSessionLivesOn) {
    Session session(1, 1);
    RenderRequest bad = request(Method::gpr);
    bad.settings.tile = 99;
    session.submit(0, bad);
    std::vector<std::string> messages;
    ASSERT_TRUE(eventually([&] {
        messages = session.take_messages();
        return !messages.empty();
    }));
    EXPECT_NE(messages[0].find("tile is 99"), std::string::npos) << messages[0];
    session.submit(0, request(Method::gpr, {16, 16}, 1));
    EXPECT_TRUE(eventually([&] { return session.latest(0) && !session.latest(0)->coarse; }));
}

TEST(Session, ReconstructionSettingsRenderNothing) {
    Session session(1, 2);
    session.submit(0, request(Method::gpr, {64, 48}, 2));
    ASSERT_TRUE(eventually([&] { return session.latest(0) && session.latest(0)->reconstruction_spp == 2; }));
    const auto before = session.latest(0);
    session.set_reconstruction(0, {Norm::none, 0.2f});
    ASSERT_TRUE(eventually([&] { return session.latest(0)->reconstruction != before->reconstruction; }));
    EXPECT_EQ(session.latest(0)->images, before->images);
    EXPECT_EQ(session.latest(0)->counters.camera_paths, before->counters.camera_paths);
}

} // namespace

} // namespace tessera::test
