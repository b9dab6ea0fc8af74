#include "tests/ui/viewer_harness.h"

#include "render/io/plain_images.h"
#include "tests/support/scene_builder.h"
#include "ui/gl/gui.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <utility>

#include <glad/gl.h>
#include <gtest/gtest.h>

namespace tessera::test {

std::shared_ptr<const Scene> viewer_scene() {
    SceneBuilder room;
    const int white = room.diffuse(Rgb(0.75f));
    room.room({white, white, white, room.diffuse({0.63f, 0.065f, 0.05f}), room.diffuse({0.14f, 0.45f, 0.091f})});
    room.quad({-0.4f, 0.98f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}, white, room.light(Rgb(9, 8, 6)));
    room.sphere({0.3f, -0.55f, 0.1f}, 0.45f, white);
    room.camera({0, 0, 3.4f}, {0, 0, 0}, 40);
    return room.build();
}

ViewerOptions ViewerHarness::two_panes() {
    ViewerOptions options;
    options.panes.resize(2);
    options.panes[0].render.method = Method::pt;
    options.panes[1].render.method = Method::gpr;
    options.max_depth = 4;
    options.size = {SizeChoice::Base::custom, 1, {48, 36}};
    return options;
}

SceneOrigin scene_in(const std::filesystem::path& file) {
    return {file.string(), {file, {}, {}}, [](SceneNotes&, LoadProgress&) { return viewer_scene(); }};
}

ViewerHarness::ViewerHarness(glm::ivec2 size, float scale, ViewerOptions options, int threads)
    : context(size), gui(scale), scale_(scale), session(most_panes, threads), viewer(session, std::move(options)) {
    state().layout.open_sections = ~0u; // shows all controls
}

void ViewerHarness::frame(float seconds) {
    state().layout.display_scale = scale_;
    gui.set_style(state().layout.ui_scale(), state().layout.theme);
    gui.begin_frame(glm::vec2(context.size()), 1, seconds);
    viewer.draw_frame();
    gui.end_frame();
    saver.after_frame(viewer.state(), viewer.saver(), context.size());
}

void ViewerHarness::frames(int count) {
    for (int i = 0; i < count; ++i)
        frame();
}

bool ViewerHarness::wait_until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) {
            ADD_FAILURE() << "the wait has timed out";
            return false;
        }
        const auto begin = std::chrono::steady_clock::now();
        frame();
        glFinish(); // waits for llvmpipe's threads
        // Sleeps as long as the frame took, so that background threads of lower priority make progress.
        std::this_thread::sleep_for(std::max<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begin,
                                                                       std::chrono::milliseconds(2)));
    }
    return true;
}

void ViewerHarness::finish_saving() {
    wait_until([&] { return !state().wishes.saves.has_any() && !viewer.saver().running(); });
}

void ViewerHarness::load_scene() {
    viewer.load("a room", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
    wait_until([&] {
        return pane(0).snapshot && pane(1).snapshot && !pane(0).snapshot->coarse() && !pane(1).snapshot->coarse();
    });
    frames(2);
}

void ViewerHarness::rest(int spp) {
    state().rendering.pace.spp_limit = spp;
    load_scene();
    wait_until([&] { return viewer.settled(spp); });
    // The status lines show errors, which are measured a little later.
    const auto is_measured = [&](const PaneState& p) {
        const PaneChart& chart = state().charts.of(p);
        return chart.generation == p.generation && chart.reference == state().companions.reference &&
               !chart.curves.empty() && chart.curves.back().points().back().spp == spp;
    };
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(spp > 1 ? 5 : 0);
    while (!std::ranges::all_of(state().panes, is_measured) && std::chrono::steady_clock::now() < end)
        frame();
    frames(1);
}

void ViewerHarness::move_to(glm::vec2 position) {
    send_mouse_position({position.x, position.y});
    frames(2);
}

void ViewerHarness::press(int button) {
    send_mouse_button(button, true);
    frames(2);
}

void ViewerHarness::release(int button) {
    send_mouse_button(button, false);
    frames(3);
}

void ViewerHarness::click(glm::vec2 position) {
    move_to(position);
    press();
    release();
}

void ViewerHarness::click_at(const std::string& control, float fraction) {
    reveal(control);
    const ControlRect rect = place(control);
    click(glm::vec2(rect.min.x + (rect.max.x - rect.min.x) * fraction, rect.center().y));
}

void ViewerHarness::reveal(const std::string& control) {
    const auto height = static_cast<float>(context.size().y);
    for (int i = 0; i < 40; ++i) {
        const ControlRect rect = place(control);
        if (rect.min.y >= 0 && rect.max.y <= height)
            return;
        move_to({rect.center().x, height * 0.5f});
        wheel(rect.min.y < 0 ? 1 : -1);
    }
}

void ViewerHarness::choose(const std::string& control, const std::string& item) {
    click_at(control, 0.3f);
    click(control + "/" + item);
}

void ViewerHarness::drag(glm::vec2 from, glm::vec2 by, int button) {
    move_to(from);
    press(button);
    for (int i = 1; i <= 4; ++i)
        move_to(from + by * (static_cast<float>(i) / 4));
    release(button);
}

void ViewerHarness::wheel(float notches) {
    send_mouse_wheel(notches);
    frames(2);
}

void ViewerHarness::modifiers(bool ctrl, bool shift) {
    send_modifiers(ctrl, shift);
    frame();
}

void ViewerHarness::type(Key key, bool ctrl, bool shift) {
    viewer.keyboard().press(key, key, ctrl, shift);
    viewer.keyboard().release(key);
    frames(2);
}

void ViewerHarness::command(std::string_view name) {
    type(Key::p, true, true);
    frames(2);
    for (const char c : name)
        ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(c));
    frames(2);
    type(Key::enter);
}

void ViewerHarness::resize(glm::ivec2 size) {
    context.resize(size);
    frames(3);
}

ControlRect ViewerHarness::place(const std::string& control) const {
    const auto found = viewer.controls().rects().find(control);
    if (found != viewer.controls().rects().end())
        return found->second;
    ADD_FAILURE() << "no control " << control;
    return {};
}

double ViewerHarness::brightness(const std::string& control) const {
    const ScreenPixels pixels = screen();
    const ControlRect rect = place(control);
    double sum = 0;
    int count = 0;
    for (int y = static_cast<int>(rect.min.y); y < static_cast<int>(rect.max.y); ++y) {
        for (int x = static_cast<int>(rect.min.x); x < static_cast<int>(rect.max.x); ++x) {
            const std::uint8_t* p = pixels.at(x, y);
            sum += p[0] + p[1] + p[2];
            count += 3;
        }
    }
    return count > 0 ? sum / count : 0;
}

void ViewerHarness::save(const std::string& file) const {
    if (const char* folder = std::getenv("TESSERA_TEST_PICTURES")) {
        const ScreenPixels pixels = screen();
        write_png(std::filesystem::path(folder) / file, pixels.size, pixels.rgb);
    }
}

} // namespace tessera::test
