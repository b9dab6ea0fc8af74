// Pictures of a pane that rests hang on nothing but its samples: they are made anew, not by going on from the
// last.
#include "render/scene/scene.h"
#include "render/session/session.h"
#include "tests/support/eventually.h"
#include "tests/support/scene_builder.h"

#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

using namespace std::chrono_literals;

RenderRequest request() {
    const std::shared_ptr<const Scene> scene = all_test_scenes().front().scene;
    RenderSettings settings;
    settings.method = Method::gpr;
    settings.max_depth = 4;
    return {scene, scene->camera(), glm::ivec2(48, 32), settings};
}

/// Waits for a picture of the first pane of which something holds.
bool comes(const Session& session, const std::function<bool(const Snapshot&)>& holds) {
    return eventually([&] {
        const auto s = session.latest(0);
        return s && !s->coarse() && s->reconstruction && holds(*s);
    });
}

bool goes_on(const Snapshot& s) {
    return s.reconstruction->goes_on;
}

bool is_made_anew(const Snapshot& s) {
    return s.reconstruction_spp == s.spp && !s.reconstruction->goes_on;
}

/// To the last bit what its images and settings give.
void expect_picture_of_its_samples(const Snapshot& s) {
    const Reconstruction anew = reconstruct(*s.images, s.reconstructed_with);
    ASSERT_EQ(s.reconstruction->image.size(), anew.image.size());
    for (int y = 0; y < anew.image.height(); ++y)
        for (int x = 0; x < anew.image.width(); ++x)
            ASSERT_EQ(s.reconstruction->image(x, y), anew.image(x, y)) << x << ", " << y;
}

TEST(RestingPicture, IsMadeAnewAtALimit) {
    Session session(1, 2, [] {});
    session.submit(0, request());
    ASSERT_TRUE(comes(session, goes_on));
    const int limit = session.latest(0)->spp + 50;
    session.set_pace({Pace::Equal::time, limit, 0});
    ASSERT_TRUE(
        comes(session, [&](const Snapshot& s) { return s.spp == limit && s.reconstruction_spp == limit; }));
    const auto last = session.latest(0);
    EXPECT_FALSE(last->reconstruction->goes_on);
    expect_picture_of_its_samples(*last);
}

TEST(RestingPicture, IsMadeAnewWherePaused) {
    Session session(1, 2, [] {});
    session.submit(0, request());
    ASSERT_TRUE(comes(session, goes_on));
    session.set_paused(true);
    ASSERT_TRUE(comes(session, is_made_anew));
    std::this_thread::sleep_for(300ms); // a pass may have been under way
    ASSERT_TRUE(comes(session, is_made_anew));
    expect_picture_of_its_samples(*session.latest(0));
    session.set_paused(false);
    EXPECT_TRUE(comes(session, goes_on));
}

} // namespace

} // namespace tessera::test
