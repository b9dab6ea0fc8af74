// Invalid samples: reported once per request, and opened in the path inspector.

#include "render/inspect/inspection.h"
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"
#include "tests/ui/drawing/panes_fixture.h"
#include "tests/ui/viewer/current_folder.h"
#include "ui/inside/inside.h"

#include <algorithm>
#include <limits>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace tessera::test {
namespace {

/// Returns a room with a sphere whose radiance is not finite.
std::shared_ptr<const Scene> broken_scene() {
    SceneBuilder room;
    const int white = room.diffuse(Rgb(0.75f));
    room.room({white, white, white, white, white});
    room.quad({-0.4f, 0.98f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}, white, room.light(Rgb(9, 8, 6)));
    room.sphere({0.3f, -0.55f, 0.1f}, 0.45f, room.diffuse(Rgb(std::numeric_limits<float>::quiet_NaN())));
    room.camera({0, 0, 3.4f}, {0, 0, 0}, 40);
    return room.build();
}

TEST(InvalidSamples, AreReportedOncePerRequest) {
    ViewerHarness h;
    h.state().rendering.pace.spp_limit = 3;
    h.state().layout.show_statistics = true;
    h.viewer.load("broken", [](SceneNotes&, LoadProgress&) { return broken_scene(); });
    h.wait_until([&] { return h.viewer.settled(3); });
    h.frames(3);
    const auto told = [&](const std::string& method) {
        return std::count_if(h.state().messages.begin(), h.state().messages.end(), [&](const Message& m) {
            return m.text.rfind(method + ": ", 0) == 0 && m.text.find("pass 0, pixel (") != std::string::npos &&
                   m.text.find("seed 0") != std::string::npos;
        });
    };
    EXPECT_EQ(told("PT"), 1);
    EXPECT_EQ(told("G-PR"), 1);
    EXPECT_EQ(h.state().messages.size(), 2u);
    EXPECT_TRUE(h.has("statistics.refused"));
    h.type(Key::f2);
    h.save("refused.png");
    h.state().wishes.restart = true;
    h.frame();
    h.wait_until([&] { return h.viewer.settled(3); });
    h.frames(3);
    EXPECT_EQ(told("G-PR"), 2);
}

TEST(InvalidSamples, OpenWithTheirRender) {
    ViewerHarness h;
    h.state().rendering.pace.spp_limit = 2;
    h.viewer.load("broken", [](SceneNotes&, LoadProgress&) { return broken_scene(); });
    h.wait_until([&] { return h.viewer.settled(2) && h.state().messages.size() == 2; });
    const Message gpr = *std::find_if(h.state().messages.begin(), h.state().messages.end(),
                                      [](const Message& m) { return m.text.rfind("G-PR", 0) == 0; });
    const Camera camera = h.state().camera.camera();
    // The message stays with another method and view of the same scene.
    h.state().panes[1].settings.render.method = Method::pr;
    h.state().panes[1].settings.render.seed = 5;
    h.state().camera.dolly(-3);
    h.frames(2);
    h.wait_until([&] { return h.viewer.settled(2); });
    h.state().messages = {gpr};
    h.state().layout.show_messages = true;
    h.frames(2);
    h.click("inspect_message0");
    ASSERT_TRUE(h.wait_until([&] { return h.state().inspector.inspection != nullptr; }));
    const Inspection& found = *h.state().inspector.inspection;
    EXPECT_EQ(found.method, Method::gpr);
    EXPECT_TRUE(found.is_invalid);
    EXPECT_EQ(found.pixel, gpr.samples[0].pixel);
    const glm::vec4 seen = Projection(camera, found.size).project(found.path.front().position);
    EXPECT_EQ(glm::ivec2(glm::vec2(seen) / seen.w), found.pixel);
    EXPECT_FALSE(h.state().shows_request(gpr.samples[0].origin->generation));
    h.frames(3);
    h.save("refused-earlier.png");

    // The inspector keeps the sample after a change of scene.
    h.viewer.load("a room", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
    h.wait_until([&] { return h.viewer.settled(2); });
    h.frames(5);
    EXPECT_TRUE(h.state().inspector.inspection->is_invalid);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(InvalidSamples, OpenInTurn) {
    ViewerHarness h;
    h.state().rendering.pace.spp_limit = 1;
    h.viewer.load("broken", [](SceneNotes&, LoadProgress&) { return broken_scene(); });
    h.wait_until([&] { return h.viewer.settled(1) && h.state().messages.size() == 2; });
    h.state().messages.pop_back();
    auto& samples = h.state().messages[0].samples;
    ASSERT_EQ(samples.size(), FirstInvalid::most);
    samples.resize(3);
    for (const std::size_t i : {0u, 1u, 2u, 0u}) { // and the first again
        h.state().layout.show_messages = true;
        h.frames(2);
        const SampleChoice sample = h.state().messages[0].samples[i];
        h.save("refused-" + std::to_string(i) + ".png");
        h.click("inspect_message0");
        ASSERT_TRUE(h.wait_until([&] {
            const auto& inspection = h.state().inspector.inspection;
            return inspection && inspection->pixel == sample.pixel;
        })) << i;
        EXPECT_TRUE(h.state().inspector.inspection->is_invalid) << i;
        EXPECT_EQ(h.state().inspector.inspection->pass, *sample.pass) << i;
    }
}

TEST(InvalidSamples, OfAReferenceCanBeOpened) {
    const CurrentFolder folder;
    ViewerHarness h;
    h.state().rendering.pace.spp_limit = 1;
    h.viewer.load("broken", [](SceneNotes&, LoadProgress&) { return broken_scene(); });
    h.wait_until([&] { return h.viewer.settled(1) && h.state().messages.size() == 2; });
    h.state().reference_making.spp = 2;
    h.state().wishes.make_reference = true;
    const auto told = [&] { return h.state().messages.size() > 4; }; // two for the halves, and the final one
    ASSERT_TRUE(h.wait_until(told));
    h.state().messages.erase(h.state().messages.begin(), h.state().messages.begin() + 2);
    const Message& second = h.state().messages[1];
    EXPECT_EQ(second.text.rfind("The reference: ", 0), 0u) << second.text;
    EXPECT_NE(second.text.find("seed 1002"), std::string::npos) << second.text;
    h.state().layout.show_messages = true;
    h.frames(2);
    h.click("inspect_message1");
    ASSERT_TRUE(h.wait_until([&] { return h.state().inspector.inspection != nullptr; }));
    EXPECT_TRUE(h.state().inspector.inspection->is_invalid);
    EXPECT_EQ(h.state().inspector.sample->origin->settings.seed, 1002u);
}

TEST(InvalidSamples, OfAReplacedSceneDoNotKeepIt) {
    ViewerState state;
    state.scene = viewer_scene();
    Counters counters;
    counters.refuse({0, 1, 2});
    const PassOrigin here{state.scene, state.scene->camera(), {48, 36}, {}};
    state.add_invalid("The reference", counters, 0, here);
    EXPECT_EQ(state.messages.back().samples.size(), 1u);
    state.scene = viewer_scene();
    state.add_invalid("The reference", counters, 0, here);
    ASSERT_EQ(state.messages.size(), 2u);
    EXPECT_TRUE(state.messages.back().samples.empty());
}

} // namespace
} // namespace tessera::test
