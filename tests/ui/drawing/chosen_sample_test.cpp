// Inspection of a sample given by pixel, pass and seed: in the dialog, an option, a script or a message.

#include "render/inspect/inspection.h"
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/ui/viewer_harness.h"
#include "ui/viewer/script.h"

#include <chrono>
#include <cstdint>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <imgui.h>

namespace tessera::test {
namespace {

constexpr glm::ivec2 size(48, 36);
constexpr glm::ivec2 pixel(20, 15);
constexpr int pass = 5;
constexpr std::uint64_t seed = 12345678901234567890u; // needs 64 bits

/// The contributions to a pixel and their base pixels, as bits of floats.
std::vector<float> bits(const Inspection& seen) {
    std::vector<float> result;
    const auto add = [&](Rgb c) { result.insert(result.end(), {c.r, c.g, c.b}); };
    add(seen.radiance);
    for (const InspectedVertex& x : seen.path)
        add(x.position);
    for (const InspectedSet& set : seen.sets)
        for (const InspectedShift* s : set.to(seen.pixel)) {
            add(Rgb(s->from, 0));
            add(s->value);
        }
    return result;
}

/// Traces the sample as `tessera render` does, with the LearnedReuse of its pass.
std::vector<float> bits_of_render(const Scene& scene, RenderSettings settings) {
    const std::shared_ptr<const Scene> kept(&scene, [](const Scene*) {});
    settings.seed = seed;
    Render render(kept, scene.camera(), size, settings);
    ThreadPool pool(1);
    while (render.spp() <= pass)
        render.pass(pool);
    const auto taken = [&](const LearnedReuse& learned) {
        return bits(inspect(scene, scene.camera(), size, settings, learned, pass, pixel));
    };
    EXPECT_NE(taken(*render.newest_learned()), taken(LearnedReuse(size, settings))); // earlier passes matter
    return taken(*render.newest_learned());
}

struct ChosenSample : testing::Test, ViewerHarness {
    using ViewerHarness::ViewerHarness;

    const Inspector& inspector() { return state().inspector; }
    bool wait_for_sample() {
        return wait_until([&] { return inspector().inspection && !viewer.inspecting(); });
    }
    void expect_that_of_the_render() {
        ASSERT_TRUE(wait_for_sample());
        EXPECT_EQ(inspector().inspection->pixel, pixel);
        EXPECT_EQ(inspector().inspection->pass, pass);
        EXPECT_EQ(inspector().inspection->method, Method::gpr);
        EXPECT_EQ(bits(*inspector().inspection), bits_of_render(*state().scene, pane(1).settings.render));
    }
    void type_into(const std::string& control, const std::string& text) {
        click_at(control, 0.2f);
        click_at(control, 0.2f); // a double click selects all text
        for (char c : text) {
            ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
            frame();
        }
        move_to(place("sample.close").center()); // the value is set when the control loses focus
    }
    void play(const std::string& text) {
        std::istringstream stream(text);
        ScriptPlayer player(parse_script(stream, "steps.txt"), "steps.txt", viewer, {});
        wait_until([&] {
            player.before_frame(0.01);
            frame();
            player.after_frame();
            return player.done();
        });
    }
    std::string newest_message() { return state().messages.empty() ? "" : state().messages.back().text; }
};

TEST_F(ChosenSample, OfTheDialogEqualsTheRender) {
    rest(2);
    const RenderSettings before = pane(1).settings.render;
    click("menu View");
    click("menu View/Inspect a sample ...");
    ASSERT_TRUE(state().layout.sample_form.show);
    frames(2);
    save("sample-dialog.png");
    EXPECT_TRUE(viewer.controls().unexplained().count("sample.seed") == 0);
    type_into("sample.x", std::to_string(pixel.x));
    type_into("sample.y", std::to_string(pixel.y));
    type_into("sample.pass", std::to_string(pass));
    type_into("sample.seed", std::to_string(seed));
    EXPECT_EQ(pane(1).settings.render, before); // nothing changes before the button is pressed
    click("sample.inspect");
    EXPECT_FALSE(state().layout.sample_form.show);
    EXPECT_EQ(pane(0).settings.render.seed, seed); // the seed is linked
    expect_that_of_the_render();
    frames(3);
    save("sample-chosen.png");
    // Opened again, the dialog shows the inspected sample.
    type(Key::i, true);
    EXPECT_EQ(state().layout.sample_form.pixel, pixel);
    EXPECT_EQ(state().layout.sample_form.pass, pass);
    EXPECT_EQ(state().layout.sample_form.seed, seed);
    type(Key::escape);
    EXPECT_FALSE(state().layout.sample_form.show);
}

TEST_F(ChosenSample, OfAScriptEqualsTheRender) {
    state().rendering.pace.spp_limit = 1;
    viewer.load("a room", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
    play("wait scene\nset seed " + std::to_string(seed) + "\ninspect 20 15 5");
    ASSERT_TRUE(inspector().inspection); // the step has waited for the inspection
    expect_that_of_the_render();
}

/// The panes are paused and have no picture.
TEST_F(ChosenSample, NeedsNoPicture) {
    state().rendering.paused = true;
    viewer.load("a room", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
    ASSERT_TRUE(wait_until([&] { return state().scene != nullptr; }));
    state().inspect(pixel, pass, seed);
    expect_that_of_the_render();
    EXPECT_TRUE(!pane(1).snapshot || pane(1).snapshot->coarse());
}

struct SampleOfAnOption : ChosenSample {
    static ViewerOptions options() {
        ViewerOptions options = two_panes();
        options.panes[1].render.seed = seed;
        options.sample = SampleChoice{0, pixel, pass};
        return options;
    }
    SampleOfAnOption() : ChosenSample({1280, 720}, 1, options()) {}
};

TEST_F(SampleOfAnOption, EqualsTheRender) {
    frames(3);
    EXPECT_TRUE(has("inspector.follow")); // before a scene is loaded
    load_scene();
    expect_that_of_the_render();
}

TEST_F(ChosenSample, IsTracedAgainForNewRequestsOfItsPane) {
    rest(3);
    state().inspect({7, 9}, 1, 0);
    ASSERT_TRUE(wait_for_sample());
    state().active().settings.render.method = Method::pr;
    ASSERT_TRUE(wait_until([&] { return inspector().inspection->method == Method::pr && !viewer.inspecting(); }));
    EXPECT_EQ(inspector().inspection->pass, 1);
}

TEST_F(ChosenSample, FollowReplacesItByTheNewestPass) {
    rest(3);
    type(Key::i);
    state().inspector.follow(true);
    state().inspect({7, 9}, 1, 0);
    EXPECT_FALSE(inspector().follows); // a given pass does not follow
    ASSERT_TRUE(wait_for_sample());
    EXPECT_EQ(inspector().inspection->pass, 1);
    click("inspector.follow");
    EXPECT_TRUE(inspector().follows);
    ASSERT_TRUE(wait_until([&] { return inspector().inspection && inspector().inspection->pass == 2; }));
    state().rendering.pace.spp_limit = 5;
    EXPECT_TRUE(wait_until([&] { return inspector().inspection->pass == 4; }));
    EXPECT_EQ(inspector().inspection->pixel, glm::ivec2(7, 9));
}

TEST_F(ChosenSample, FollowReplacesTheSampleOfAMessage) {
    rest(3);
    const PassOrigin earlier{state().scene, pane(1).snapshot->camera, size, pane(1).settings.render, {}, 0};
    state().inspect({pane(1).slot, {7, 9}, 1, std::make_shared<const PassOrigin>(earlier)});
    ASSERT_TRUE(wait_for_sample());
    EXPECT_NE(inspector().generation, pane(1).generation);
    frames(2);
    click("inspector.follow");
    ASSERT_TRUE(wait_until([&] { return inspector().generation == pane(1).generation; }));
    EXPECT_EQ(inspector().inspection->pass, 2);
}

TEST_F(ChosenSample, OutsideThePictureIsAnError) {
    rest(2);
    state().inspect({48, 10}, 0, 0);
    frames(3);
    EXPECT_EQ(newest_message(), "There is no pixel (48, 10) to inspect: the picture has 48 x 36 pixels.");
    EXPECT_FALSE(inspector().sample);
    EXPECT_TRUE(inspector().active); // a click can choose another pixel
}

TEST_F(ChosenSample, OutsideASmallerPictureIsDropped) {
    rest(2);
    state().inspect({40, 30}, 0, 0);
    ASSERT_TRUE(wait_for_sample());
    state().rendering.size = {SizeChoice::Base::custom, 1, {20, 15}};
    ASSERT_TRUE(wait_until([&] { return !inspector().sample; }));
    EXPECT_FALSE(inspector().inspection);
}

TEST_F(ChosenSample, OneReplacedInTheSameFrameIsNotShown) {
    rest(2);
    state().inspect({pane(1).slot, {7, 9}, {}});
    frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(300)); // the inspection is complete, but not taken
    state().inspect({pane(1).slot, {3, 4}, {}});
    frame();
    EXPECT_FALSE(inspector().inspection);
    ASSERT_TRUE(wait_for_sample());
    EXPECT_EQ(inspector().inspection->pixel, glm::ivec2(3, 4));
    EXPECT_FALSE(viewer.all_drawn()); // the result has just arrived
    frames(4);
    EXPECT_TRUE(viewer.all_drawn());
}

/// The replay of a late pass takes long. A sample that is replaced does not delay the next one.
TEST_F(ChosenSample, IsCancelledByAnother) {
    rest(2);
    state().inspect(pixel, 2000000000, 0);
    frames(3);
    EXPECT_TRUE(viewer.inspecting());
    EXPECT_FALSE(inspector().inspection);
    save("sample-sought.png");
    state().inspect({3, 4}, 0, 0);
    ASSERT_TRUE(wait_for_sample());
    EXPECT_EQ(inspector().inspection->pixel, glm::ivec2(3, 4));
    state().inspect(pixel, 2000000000, 0);
    frames(3);
    EXPECT_TRUE(viewer.inspecting());
    click("inspector.close");
    EXPECT_FALSE(viewer.inspecting());
}

TEST_F(ChosenSample, OfAScriptNeedsAValidPixelAndPass) {
    rest(2);
    for (const char* step : {"inspect 1.5 2 0", "inspect 1 2 -1", "inspect a 2 0", "inspect 1 2"})
        EXPECT_THROW(play(step), ScriptError) << step;
    EXPECT_THROW(play("set seed -1"), ScriptError);
    EXPECT_THROW(play("inspect 1000 2 0"), ScriptError); // the viewer's error message
}

} // namespace
} // namespace tessera::test
