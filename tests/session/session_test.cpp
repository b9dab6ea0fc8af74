// Guarantees for the viewer: the newest request wins, old requests publish nothing, and pausing publishes.
#include "render/scene/scene.h"
#include "render/session/session.h"
#include "tests/support/eventually.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <new>
#include <thread>
#include <utility>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

using namespace std::chrono_literals;

std::shared_ptr<const Scene> scene() {
    static const std::shared_ptr<const Scene> s = all_test_scenes().front().scene;
    return s;
}

RenderRequest request(Method method, glm::ivec2 size = {48, 32}) {
    RenderSettings settings;
    settings.method = method;
    settings.max_depth = 4;
    return {scene(), scene()->camera(), size, settings};
}

Pace until(int spp) {
    return {Pace::Equal::time, spp, 0};
}

/// Waits until the number of samples of the pane stays constant for 0.3 s.
bool comes_to_rest(const Session& session, int pane) {
    return eventually([&] {
        const int spp = session.latest(pane)->spp;
        std::this_thread::sleep_for(300ms);
        return session.latest(pane)->spp == spp;
    });
}

/// Returns the time in seconds by which a pane may be ahead of its turn: some passes, and unpublished samples.
/// Passes are long on a slow or busy machine.
double seconds_of_a_turn(const Session& session, int pane) {
    const auto s = session.latest(pane);
    return 0.25 + 5 * s->seconds / s->spp;
}

TEST(Session, PublishesACoarsePictureFirstAndReconstructs) {
    std::atomic<int> published = 0;
    Session session(1, 2, [&] { ++published; });
    session.set_pace(until(2));
    const std::uint64_t generation = session.submit(0, request(Method::gpr, {200, 120}));
    ASSERT_TRUE(eventually([&] { return session.latest(0) != nullptr; }));
    const auto first = session.latest(0);
    EXPECT_EQ(first->generation, generation);
    EXPECT_TRUE(first->coarse());
    EXPECT_EQ(first->images->primal.width(), 50);
    ASSERT_TRUE(eventually([&] {
        const auto s = session.latest(0);
        return s->spp == 2 && s->reconstruction_spp == 2;
    }));
    const auto last = session.latest(0);
    EXPECT_FALSE(last->coarse());
    EXPECT_EQ(last->images->primal.width(), 200);
    EXPECT_EQ(last->reconstruction->image.width(), 200);
    EXPECT_TRUE(eventually([&] { return published >= 3; })); // the callback follows publication
}

TEST(Session, PreviewsAppearDuringRequestsAndGrowFinerAfterwards) {
    std::mutex mutex;
    std::vector<std::pair<std::uint64_t, int>> seen; // generation and divisor of each snapshot
    std::atomic<Session*> all{nullptr};
    Session session(1, 2, [&] {
        const std::lock_guard lock(mutex); // locked first, because two threads publish
        Session* of = all;
        if (const auto s = of ? of->latest(0) : nullptr) {
            if (seen.empty() || seen.back() != std::pair(s->generation, s->divisor))
                seen.emplace_back(s->generation, s->divisor);
        }
    });
    all = &session;
    session.set_pace(until(1));
    std::uint64_t last = 0;
    const RenderRequest r = request(Method::gpr, {640, 480}); // large, so that previews are slow
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t previews = 0; previews < 3 && std::chrono::steady_clock::now() - begin < 2min;) {
        last = session.submit(0, r); // as a dragged camera does
        std::this_thread::sleep_for(5ms);
        const std::lock_guard lock(mutex);
        previews = seen.size();
    }
    ASSERT_TRUE(eventually([&] { // the callback may be later than publication
        const std::lock_guard lock(mutex);
        return !seen.empty() && seen.back() == std::pair(last, 1);
    }));
    const std::lock_guard lock(mutex);
    ASSERT_GE(seen.size(), 3u);
    std::vector<int> of_last;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (seen[i].first == last)
            of_last.push_back(seen[i].second);
        else
            EXPECT_GT(seen[i].second, 1) << i; // outdated requests publish no whole picture
    }
    EXPECT_GE(of_last.size(), 2u);
    EXPECT_TRUE(std::is_sorted(of_last.rbegin(), of_last.rend())) << "each is finer than the previous one";
}

TEST(Session, NewestOfManyRequestsWins) {
    Session session(2, 2);
    session.set_pace(until(1));
    std::uint64_t newest = 0;
    for (int i = 0; i < 200; ++i) {
        RenderRequest r = request(all_methods[i % 4], {40 + i % 7, 30});
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
        return s && s->generation == newest && !s->coarse();
    }));
    EXPECT_EQ(session.latest(1)->settings.seed, 199u);
    EXPECT_TRUE(session.take_messages().empty());
}

TEST(Session, PausePublishesAndStops) {
    Session session(1, 2);
    session.submit(0, request(Method::pt));
    ASSERT_TRUE(eventually([&] { return session.latest(0) && session.latest(0)->spp > 3; }));
    session.set_paused(true);
    EXPECT_TRUE(comes_to_rest(session, 0));
    const int spp = session.latest(0)->spp;
    session.set_paused(false);
    EXPECT_TRUE(eventually([&] { return session.latest(0)->spp > spp; }));
}

/// Returns whether the latest snapshot is a whole picture reconstructed with this norm.
bool is_made_with(const Session& session, Norm norm) {
    const auto s = session.latest(0);
    return s && !s->coarse() && s->reconstruction && s->reconstructed_with.norm == norm;
}

/// Renders one pass, so large that its L1 reconstruction takes half a second on an idle machine. Waits for the
/// primal.
bool shows_a_large_primal(Session& session) {
    session.set_pace(until(1));
    session.set_reconstruction(0, {Norm::none});
    RenderRequest large = request(Method::gpt, {1280, 720});
    large.settings.max_depth = 1;
    session.submit(0, large);
    return eventually([&] { return is_made_with(session, Norm::none); });
}

TEST(Session, NewSettingsCancelTheRunningReconstruction) {
    std::atomic<bool> saw_l1{false};
    std::atomic<Session*> all{nullptr};
    Session session(1, 2, [&] {
        Session* of = all;
        const auto s = of ? of->latest(0) : nullptr;
        saw_l1 = saw_l1 || (s && s->reconstruction && s->reconstructed_with.norm == Norm::l1);
    });
    ASSERT_TRUE(shows_a_large_primal(session));
    all = &session; // set while nothing is published
    bool was_too_late = true;
    for (int attempt = 0; attempt < 20 && was_too_late; ++attempt) {
        session.set_reconstruction(0, {Norm::none});
        ASSERT_TRUE(eventually([&] { return is_made_with(session, Norm::none) && !session.reconstructing(0); }));
        saw_l1 = false;
        session.set_reconstruction(0, {Norm::l1});
        ASSERT_TRUE(eventually([&] { return saw_l1 || session.reconstructing(0); }));
        session.set_reconstruction(0, {Norm::l2});
        was_too_late = saw_l1 || is_made_with(session, Norm::l1); // L1 finished before this thread could cancel it
        ASSERT_TRUE(eventually([&] { return is_made_with(session, Norm::l2); }));
    }
    ASSERT_FALSE(was_too_late);
    EXPECT_FALSE(saw_l1);
}

TEST(Session, ReconstructionCanBeCancelled) {
    Session session(1, 2);
    ASSERT_TRUE(shows_a_large_primal(session));
    ASSERT_TRUE(eventually([&] { return !session.reconstructing(0); }));
    session.set_reconstruction(0, {Norm::l1});
    ASSERT_TRUE(eventually([&] { return session.reconstructing(0).has_value(); }));
    EXPECT_EQ(session.reconstructing(0)->spp, 1);
    session.stop_reconstruction(0);
    ASSERT_TRUE(eventually([&] { return !session.reconstructing(0); }));
    std::this_thread::sleep_for(50ms);
    EXPECT_FALSE(session.reconstructing(0)); // it does not restart
    EXPECT_TRUE(is_made_with(session, Norm::none));
    session.set_reconstruction(0, {Norm::l2});
    EXPECT_TRUE(eventually([&] { return is_made_with(session, Norm::l2); }));
}

TEST(Session, PanesGetEqualTime) {
    Session session(2, 2);
    session.submit(0, request(Method::pt, {96, 64}));
    session.submit(1, request(Method::gpr, {96, 64}));
    ASSERT_TRUE(eventually([&] {
        const auto a = session.latest(0), b = session.latest(1);
        return a && b && a->seconds > 0.5 && b->seconds > 0.5;
    }));
    session.set_paused(true);
    EXPECT_TRUE(comes_to_rest(session, 0) && comes_to_rest(session, 1));
    EXPECT_NEAR(session.latest(0)->seconds, session.latest(1)->seconds, seconds_of_a_turn(session, 1));
}

TEST(Session, LatePaneCatchesUpInTime) {
    Session session(2, 2);
    session.submit(0, request(Method::pt, {96, 64}));
    ASSERT_TRUE(eventually([&] { return session.latest(0) && session.latest(0)->seconds > 1.2; }));
    session.submit(1, request(Method::gpr, {96, 64}));
    const double seconds_before = session.latest(0)->seconds;
    ASSERT_TRUE(eventually([&] { return session.latest(1) && session.latest(1)->seconds > 0.9; }));
    // The first pane waits, except for a running pass and unpublished samples. With equal turns, it would have
    // gained 0.9 s.
    EXPECT_LT(session.latest(0)->seconds - seconds_before, 0.1 + seconds_of_a_turn(session, 0));
    EXPECT_TRUE(
        eventually([&] { return session.latest(0)->seconds > seconds_before + 0.4; })); // then both panes render
    EXPECT_NEAR(session.latest(0)->seconds, session.latest(1)->seconds, 0.1 + seconds_of_a_turn(session, 1));
}

TEST(Session, PanesCanGetEqualSamplesInstead) {
    Session session(2, 2);
    session.set_pace({Pace::Equal::spp, 0, 0});
    session.submit(0, request(Method::pt, {96, 64}));
    session.submit(1, request(Method::gpr, {96, 64})); // several times slower
    ASSERT_TRUE(eventually([&] { return session.latest(1) && session.latest(1)->spp > 20; }));
    session.set_paused(true);
    EXPECT_TRUE(comes_to_rest(session, 0) && comes_to_rest(session, 1));
    EXPECT_NEAR(session.latest(0)->spp, session.latest(1)->spp, 1);
    EXPECT_LT(session.latest(0)->seconds, session.latest(1)->seconds);
}

TEST(Session, StopsAtATimeLimitAndResumesWhenItIsRaised) {
    Session session(1, 2);
    session.set_pace({Pace::Equal::time, 0, 0.2});
    const std::uint64_t generation = session.submit(0, request(Method::pt));
    ASSERT_TRUE(eventually([&] { return session.latest(0) && session.latest(0)->seconds >= 0.2; }));
    EXPECT_TRUE(comes_to_rest(session, 0));
    const int spp = session.latest(0)->spp;
    EXPECT_LT(session.latest(0)->seconds, 0.2 + seconds_of_a_turn(session, 0));
    session.set_pace({});
    ASSERT_TRUE(eventually([&] { return session.latest(0)->spp > spp; }));
    EXPECT_EQ(session.latest(0)->generation, generation);
}

TEST(Session, StepsOnePassWhilePausedAndBeyondALimit) {
    Session session(2, 2);
    session.set_pace(until(2));
    session.submit(0, request(Method::pt));
    session.submit(1, request(Method::gpr));
    const auto both_at = [&](int spp) {
        return eventually([&] {
            return session.latest(0) && session.latest(1) && session.latest(0)->spp == spp &&
                   session.latest(1)->spp == spp && !session.latest(1)->coarse();
        });
    };
    ASSERT_TRUE(both_at(2));
    session.step();
    ASSERT_TRUE(both_at(3));
    session.set_paused(true);
    session.set_pace({});
    session.step();
    session.step();
    ASSERT_TRUE(both_at(5));
    std::this_thread::sleep_for(200ms);
    EXPECT_EQ(session.latest(0)->spp, 5);
}

TEST(Session, WithdrawnPaneTakesNoTurns) {
    Session session(2, 2);
    session.submit(0, request(Method::pt));
    session.submit(1, request(Method::pt));
    ASSERT_TRUE(eventually([&] { return session.latest(0) && session.latest(1) && session.latest(1)->spp > 3; }));
    session.withdraw(1);
    EXPECT_EQ(session.latest(1), nullptr);
    const int spp = session.latest(0)->spp;
    ASSERT_TRUE(eventually([&] { return session.latest(0)->spp > spp + 20; }));
    EXPECT_EQ(session.latest(1), nullptr);
    const std::uint64_t again = session.submit(1, request(Method::gpr));
    EXPECT_TRUE(eventually([&] { return session.latest(1) && session.latest(1)->generation == again; }));
}

TEST(Session, BadSettingsGiveAMessageAndTheSessionContinues) {
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
    session.submit(0, request(Method::gpr, {16, 16}));
    EXPECT_TRUE(eventually([&] { return session.latest(0) && !session.latest(0)->coarse(); }));
}

TEST(Session, FailedRenderIsReportedUntilTheNextRequest) {
    Session session(1, 1);
    RenderRequest bad = request(Method::gpr);
    bad.settings.tile = 99;
    session.submit(0, bad);
    EXPECT_TRUE(eventually([&] { return session.has_failed(0); }));
    session.submit(0, request(Method::gpr, {16, 16}));
    EXPECT_FALSE(session.has_failed(0));
}

// The callback of the session runs out of memory once, on the thread that publishes.
TEST(Session, FailedPublicationDoesNotEndTheRender) {
    std::atomic<int> published = 0;
    Session session(1, 2, [&] {
        if (++published == 2)
            throw std::bad_alloc();
    });
    session.set_reconstruction(0, {Norm::none, 0.2f});
    session.set_pace(until(40));
    session.submit(0, request(Method::pt, {96, 64}));
    EXPECT_TRUE(eventually([&] { return session.latest(0) && session.latest(0)->spp == 40; }));
    EXPECT_FALSE(session.has_failed(0));
    const auto messages = session.take_messages();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_NE(messages[0].find("is not shown"), std::string::npos) << messages[0];
}

TEST(Session, FollowingPaneReconstructsByItself) {
    Session session(3, 2);
    session.set_pace(until(4));
    session.set_reconstruction(0, {Norm::l2, 0.2f});
    session.set_reconstruction(1, {Norm::l1, 0.2f});
    const std::uint64_t generation = session.submit(0, request(Method::gpr, {64, 48}));
    EXPECT_EQ(session.follow(1, 0), generation);
    const auto has_all = [&](int pane, Norm norm) {
        const auto s = session.latest(pane);
        return s && !s->coarse() && s->spp == 4 && s->reconstruction_spp == 4 &&
               s->reconstructed_with.norm == norm;
    };
    ASSERT_TRUE(eventually([&] { return has_all(0, Norm::l2) && has_all(1, Norm::l1); }));
    EXPECT_EQ(session.latest(0)->images, session.latest(1)->images) << "both panes show one render";
    EXPECT_EQ(session.follow(2, 0), generation); // a late follower gets the existing picture
    EXPECT_TRUE(eventually([&] { return session.latest(2) && session.latest(2)->reconstruction_spp == 4; }));
    const std::uint64_t next = session.submit(0, request(Method::pt, {64, 48}));
    // Until it follows the new request, it shows its old picture or a first preview.
    const auto shown = session.latest(1);
    EXPECT_TRUE(shown->generation == generation || shown->coarse());
    EXPECT_EQ(session.follow(1, 0), next);
    EXPECT_TRUE(eventually([&] { return session.latest(1)->generation == next && session.latest(1)->spp == 4; }));
    session.submit(1, request(Method::gpt, {64, 48})); // no longer a follower
    EXPECT_TRUE(eventually([&] { return session.latest(1)->settings.method == Method::gpt; }));
    EXPECT_TRUE(session.take_messages().empty());
}

TEST(Session, ReconstructionSettingsDoNotRestartTheRender) {
    Session session(1, 2);
    session.set_pace(until(2));
    session.submit(0, request(Method::gpr, {64, 48}));
    ASSERT_TRUE(eventually([&] { return session.latest(0) && session.latest(0)->reconstruction_spp == 2; }));
    const auto before = session.latest(0);
    session.set_reconstruction(0, {Norm::none, 0.2f});
    ASSERT_TRUE(eventually([&] { return session.latest(0)->reconstruction != before->reconstruction; }));
    EXPECT_EQ(session.latest(0)->images, before->images);
    EXPECT_EQ(session.latest(0)->counters.camera_paths, before->counters.camera_paths);
}

} // namespace

} // namespace tessera::test
