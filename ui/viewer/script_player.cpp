#include "render/io/available_memory.h"
#include "ui/gl/gui.h"
#include "ui/settings/settings_file.h"
#include "ui/viewer/script.h"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr int settling_frames = 3; // Dear ImGui opens popups and sizes windows with a delay of one or two frames
constexpr int drag_frames = 8;
constexpr double wait_timeout = 600; // seconds

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Measures the delay of a pane's pictures behind its camera.
class CameraLag {
public:
    /// Appends a delay to `behind`, seconds, if the last frame showed the first picture of a camera. To be called
    /// before every frame.
    void record(const PaneState& pane, std::vector<double>& behind) {
        requested_.try_emplace(pane.generation, std::exchange(last_, now())); // the last frame's input
        const std::uint64_t shown = pane.snapshot ? pane.snapshot->generation : 0;
        if (shown == std::exchange(shown_, shown))
            return;
        if (const auto asked = requested_.find(shown); asked != requested_.end())
            behind.push_back(now() - asked->second);
    }

private:
    std::map<std::uint64_t, double> requested_; // time of the first request of each generation
    double last_ = now();                       // begin of the last frame
    std::uint64_t shown_ = 0;
};

} // namespace

ScriptPlayer::ScriptPlayer(std::vector<ScriptStep> steps, std::string file, Viewer& viewer, Outside outside)
    : steps_(std::move(steps)), file_(std::move(file)), viewer_(viewer), outside_(std::move(outside)) {}

void ScriptPlayer::before_frame(double last_frame_seconds) {
    last_frame_ = last_frame_seconds;
    if (actions_.empty() && next_ < steps_.size()) {
        const ScriptStep& step = steps_[next_++];
        line_ = step.line;
        waiting_ = false;
        try {
            start(step);
        } catch (const std::invalid_argument& error) {
            fail(error.what());
        }
    }
    if (!actions_.empty() && actions_.front()())
        actions_.pop_front();
    send_input();
}

void ScriptPlayer::after_frame() {
    if (!screenshot_)
        return;
    const std::filesystem::path file = *std::exchange(screenshot_, std::nullopt);
    try {
        outside_.screenshot(file);
    } catch (const std::exception& error) {
        fail(message_of(error));
    }
}

bool ScriptPlayer::wants_frame() const {
    return !done() && !(waiting_ && !actions_.empty());
}

void ScriptPlayer::fail(const std::string& what) const {
    throw ScriptError(file_, line_, what);
}

double ScriptPlayer::number(const std::string& text) const {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != 0)
        fail(text + " is not a number");
    return value;
}

int ScriptPlayer::whole(const std::string& text) const {
    const double value = number(text);
    if (value != std::floor(value) || value < 0 || value > std::numeric_limits<int>::max())
        fail(text + " is not a whole number of 0 or more");
    return static_cast<int>(value);
}

// --- steps ---

void ScriptPlayer::start(const ScriptStep& step) {
    const std::vector<std::string>& a = step.arguments;
    ViewerState& state = viewer_.state();
    if (step.word == "wait")
        start_wait(step);
    else if (step.word == "key" || step.word == "hold" || step.word == "release")
        start_key(step);
    else if (step.word == "frames" || step.word == "orbit")
        start_frames(step);
    else if (step.word == "set")
        set_by_name(state, a[0], a[1]);
    else if (step.word == "inspect")
        start_inspect(step);
    else if (step.word == "open")
        viewer_.drop({a[0]});
    else if (step.word == "reference")
        state.wishes.open_reference = a[0];
    else if (step.word == "screenshot")
        add([this, file = a[0]] { screenshot_ = file; });
    else if (step.word == "print")
        outside_.print(a[0]);
    else if (step.word == "quit")
        state.wishes.quit = true;
    else
        start_pointer(step);
    // The effect of a step is visible before the next step begins.
    for (int i = 0; i < settling_frames && step.word != "wait"; ++i)
        add([] {});
}

void ScriptPlayer::start_wait(const ScriptStep& step) {
    const std::string& what = step.arguments[0];
    const double amount = step.arguments.size() > 1 ? number(step.arguments[1]) : 0;
    const double began = now();
    std::function<bool()> condition;
    if (what == "scene")
        condition = [this] { return viewer_.state().scene && !viewer_.loading(); };
    else if (what == "spp")
        condition = [this, amount] { return have_samples(static_cast<int>(amount)); };
    else if (what == "seconds")
        condition = [began, amount] { return now() - began >= amount; };
    else if (what == "reference")
        condition = [&state = viewer_.state()] {
            return state.companions.reference && !state.reference_making.is_making();
        };
    else
        fail("usage: wait scene | spp N | seconds S | reference");
    waiting_ = what != "seconds";
    add_wait(condition);
}

void ScriptPlayer::start_inspect(const ScriptStep& step) {
    const std::vector<std::string>& a = step.arguments;
    ViewerState& state = viewer_.state();
    state.inspect({state.active().slot, {whole(a[0]), whole(a[1])}, whole(a[2])});
    add([] {}); // one frame, in which the viewer starts the inspection
    add_wait([this] { return viewer_.state().scene && !viewer_.inspecting(); });
}

/// Adds a wait for a condition. An error message of the viewer, or a timeout, becomes an error of the script.
void ScriptPlayer::add_wait(const std::function<bool()>& condition) {
    actions_.push_back([this, condition, began = now()] {
        for (const Message& message : viewer_.state().messages) {
            if (message.kind == Message::Kind::error)
                fail(message.text);
        }
        if (now() - began > wait_timeout)
            fail("the wait has timed out");
        return condition();
    });
}

bool ScriptPlayer::have_samples(int spp) const {
    const ViewerState& state = viewer_.state();
    for (const PaneState& pane : state.panes) {
        const Snapshot* snapshot = pane.snapshot.get();
        if (snapshot == nullptr || snapshot->generation != pane.generation || snapshot->coarse() ||
            snapshot->spp < spp)
            return false;
        if (snapshot->reconstruction_spp < spp)
            return false;
    }
    return !viewer_.loading() && state.scene;
}

void ScriptPlayer::start_key(const ScriptStep& step) {
    const auto shortcut = shortcut_named(step.arguments[0]);
    if (!shortcut)
        fail("unknown key " + step.arguments[0]);
    Keyboard& keyboard = viewer_.keyboard();
    add([&keyboard, key = *shortcut, word = step.word] {
        if (key.character != 0 && word != "release")
            return keyboard.type(key.character);
        if (word != "release")
            keyboard.press(key.key, key.key, key.ctrl, key.shift);
        if (word != "hold")
            keyboard.release(key.key);
    });
}

void ScriptPlayer::start_frames(const ScriptStep& step) {
    const auto times = std::make_shared<FrameTimes>();
    const auto lag = std::make_shared<CameraLag>();
    times->label = step.arguments[1];
    const int count = static_cast<int>(number(step.arguments[0]));
    const bool orbits = step.word == "orbit";
    const std::string pane = "pane" + std::to_string(viewer_.state().active_pane) + ".picture";
    const glm::vec2 middle = orbits ? point_on(pane) : glm::vec2(0);
    for (int i = 0; i <= count; ++i) {
        actions_.push_back([this, times, lag, orbits, middle, i, count] {
            if (i > 0)
                times->seconds.push_back(last_frame_);
            if (orbits) {
                const ViewerState& state = viewer_.state();
                lag->record(state.panes[state.active_pane], times->behind);
                mouse_ = middle + glm::vec2(i % 2 ? i : -i, 0) * (60.0f / static_cast<float>(count));
                button_ = i > 0 && i < count;
            }
            if (i == 0)
                times->period = now();
            if (i == count) {
                times->period = now() - times->period;
                outside_.print(times->text());
            }
            return true;
        });
    }
}

// --- the mouse ---

void ScriptPlayer::start_pointer(const ScriptStep& step) {
    const std::vector<std::string>& a = step.arguments;
    if (step.word == "modifiers") {
        ctrl_ = a[0] == "ctrl" || a.back() == "ctrl";
        shift_ = a[0] == "shift" || a.back() == "shift";
    } else if (step.word == "wheel") {
        add([notches = static_cast<float>(number(a[0]))] { send_mouse_wheel(notches); });
    } else if (step.word == "move") {
        mouse_ = points(step, 1)[0];
    } else if (step.word == "click") {
        add_click([point = points(step, 1)[0]] { return point; });
    } else if (step.word == "choose") {
        add_click([this, control = a[0]] { return point_on(control); });
        add_click([this, item = a[0] + "/" + a[1]] { return point_on(item); });
    } else {
        const std::vector<glm::vec2> ends = points(step, 2);
        add_drag(ends[0], ends[1], drag_frames);
    }
}

void ScriptPlayer::add(const std::function<void()>& once) {
    actions_.push_back([once] {
        once();
        return true;
    });
}

void ScriptPlayer::add_click(const std::function<glm::vec2()>& point) {
    add([this, point] { mouse_ = point(); });
    add([] {}); // Dear ImGui must see the control hovered before the click
    add([this] { button_ = true; });
    add([] {});
    add([this] { button_ = false; });
    for (int i = 0; i < settling_frames; ++i)
        add([] {});
}

void ScriptPlayer::add_drag(glm::vec2 from, glm::vec2 to, int frames) {
    add([this, from] { mouse_ = from; });
    add([] {});
    add([this] { button_ = true; });
    for (int i = 1; i <= frames; ++i)
        add([this, from, to, fraction = static_cast<float>(i) / static_cast<float>(frames)] {
            mouse_ = glm::mix(from, to, fraction);
        });
    add([this] { button_ = false; });
}

/// Returns `count` screen points from a step's arguments, each "X Y", "CONTROL" or "CONTROL@FX,FY".
std::vector<glm::vec2> ScriptPlayer::points(const ScriptStep& step, std::size_t count) const {
    std::vector<glm::vec2> result;
    const std::vector<std::string>& a = step.arguments;
    for (std::size_t i = 0; i < a.size(); ++i) {
        char* end = nullptr;
        const double x = std::strtod(a[i].c_str(), &end);
        if (*end == 0 && i + 1 < a.size()) {
            result.emplace_back(x, number(a[i + 1]));
            ++i;
        } else {
            result.push_back(point_on(a[i]));
        }
    }
    if (result.size() != count)
        fail("a point is X Y, CONTROL or CONTROL@FX,FY");
    return result;
}

glm::vec2 ScriptPlayer::point_on(const std::string& control) const {
    const std::size_t at = control.find('@');
    const auto found = viewer_.controls().rects().find(control.substr(0, at));
    if (found == viewer_.controls().rects().end())
        fail("unknown control " + control.substr(0, at) + " (--log-actions lists all controls)");
    float x = 0.5f, y = 0.5f;
    char rest = 0;
    if (at != std::string::npos && std::sscanf(control.c_str() + at, "@%f,%f%c", &x, &y, &rest) != 2)
        fail("a point on a control is CONTROL@FX,FY, not " + control);
    return glm::mix(found->second.min, found->second.max, glm::vec2(x, y));
}

void ScriptPlayer::send_input() const {
    if (!mouse_)
        return;
    send_mouse_position({mouse_->x, mouse_->y});
    send_mouse_button(0, button_);
    send_modifiers(ctrl_, shift_);
}

} // namespace tessera
