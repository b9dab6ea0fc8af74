// The picture of a resting pane depends only on its samples. It is reconstructed without cached results.
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

/// Waits for a picture of the first pane that satisfies the predicate. Returns null if none comes.
std::shared_ptr<const Snapshot> snapshot_of(const Session& session,
                                            const std::function<bool(const Snapshot&)>& holds) {
    std::shared_ptr<const Snapshot> s;
    const auto is_shown = [&] {
        s = session.latest(0);
        return s && !s->coarse() && s->reconstruction && holds(*s);
    };
    return eventually(is_shown) ? s : nullptr;
}

bool is_incremental(const Snapshot& s) {
    return s.reconstruction->goes_on;
}

bool is_from_scratch(const Snapshot& s) {
    return s.reconstruction_spp == s.spp && !s.reconstruction->goes_on;
}

/// Expects that the picture has the bits of a reconstruction from its images and settings.
void expect_picture_of_its_samples(const Snapshot& s) {
    const Reconstruction expected = reconstruct(*s.images, s.reconstructed_with);
    ASSERT_EQ(s.reconstruction->image.size(), expected.image.size());
    for (int y = 0; y < expected.image.height(); ++y)
        for (int x = 0; x < expected.image.width(); ++x)
            ASSERT_EQ(s.reconstruction->image(x, y), expected.image(x, y)) << x << ", " << y;
}

TEST(RestingPicture, IsReconstructedFromScratchAtALimit) {
    Session session(1, 2, [] {});
    session.submit(0, request());
    const auto incremental = snapshot_of(session, is_incremental);
    ASSERT_TRUE(incremental);
    const int limit = incremental->spp + 50; // above the samples that the render may have
    session.set_pace({Pace::Equal::time, limit, 0});
    const auto last =
        snapshot_of(session, [&](const Snapshot& s) { return s.spp >= limit && is_from_scratch(s); });
    ASSERT_TRUE(last);
    expect_picture_of_its_samples(*last);
}

TEST(RestingPicture, IsReconstructedFromScratchWhenPaused) {
    Session session(1, 2, [] {});
    session.submit(0, request());
    ASSERT_TRUE(snapshot_of(session, is_incremental));
    session.set_paused(true);
    const auto last = snapshot_of(session, is_from_scratch);
    ASSERT_TRUE(last);
    expect_picture_of_its_samples(*last);
    session.set_paused(false);
    EXPECT_TRUE(snapshot_of(session, is_incremental));
}

} // namespace

} // namespace tessera::test
