// Pictures of a pane that rests hang on nothing but its samples: they are made anew, and do not go on from others.
#include "render/scene/scene.h"
#include "render/session/session.h"
#include "tests/support/eventually.h"
#include "tests/support/scene_builder.h"

#include <functional>
#include <memory>

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

/// Waits for a picture of the first pane of which something holds. Empty: none came.
std::shared_ptr<const Snapshot> snapshot_of(const Session& session,
                                            const std::function<bool(const Snapshot&)>& holds) {
    std::shared_ptr<const Snapshot> s;
    const auto comes = [&] {
        s = session.latest(0);
        return s && !s->coarse() && s->reconstruction && holds(*s);
    };
    return eventually(comes) ? s : nullptr;
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
    const auto going_on = snapshot_of(session, goes_on);
    ASSERT_TRUE(going_on);
    const int limit = going_on->spp + 50; // the render may be beyond it
    session.set_pace({Pace::Equal::time, limit, 0});
    const auto last = snapshot_of(session, [&](const Snapshot& s) { return s.spp >= limit && is_made_anew(s); });
    ASSERT_TRUE(last);
    expect_picture_of_its_samples(*last);
}

TEST(RestingPicture, IsMadeAnewWherePaused) {
    Session session(1, 2, [] {});
    session.submit(0, request());
    ASSERT_TRUE(snapshot_of(session, goes_on));
    session.set_paused(true);
    const auto last = snapshot_of(session, is_made_anew);
    ASSERT_TRUE(last);
    expect_picture_of_its_samples(*last);
    session.set_paused(false);
    EXPECT_TRUE(snapshot_of(session, goes_on));
}

} // namespace

} // namespace tessera::test
