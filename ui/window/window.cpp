#include "ui/gl/gui.h"
#include "ui/viewer/viewer.h"
#include "ui/window/desktop.h"
#include "ui/window/surface.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include <GLFW/glfw3.h>
#include <glad/gl.h>
#include <glm/common.hpp>
#include <imgui.h>
#include <imgui_impl_glfw.h>

namespace tessera {

namespace {

constexpr int frames_after_input = 3; // Dear ImGui needs a frame or two more for sizes and popups
constexpr double longest_sleep = 1.0; // limits the delay after a missed wake-up

std::string last_glfw_error;

void note_glfw_error(int, const char* text) {
    last_glfw_error = text;
}

class Window final : public Surface {
public:
    ~Window() override;
    std::string open(const SurfaceOptions& options);

    void run(Viewer& viewer, const FrameHooks& hooks) override;
    void wake() override;
    void set_title(const std::string& title) override;
    glm::ivec2 pixels() const override;

private:
    void install_callbacks();
    void wait_until_due(double next_frame_in);
    void record_place(ViewerState& state) const;
    static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }
    static void on_key(GLFWwindow* window, int key, int scancode, int action, int mods);
    static void on_character(GLFWwindow* window, unsigned character);
    static void on_cursor(GLFWwindow* window, double x, double y);
    static void on_button(GLFWwindow* window, int button, int action, int mods);
    static void on_focus(GLFWwindow* window, int focused);
    static void on_drop(GLFWwindow* window, int count, const char** paths);
    void input_came() { frames_due_ = frames_after_input; }

    GLFWwindow* window_ = nullptr;
    std::unique_ptr<Gui> gui_;
    bool backend_ready_ = false;
    float wanted_scale_ = 1;
    Viewer* viewer_ = nullptr; // while it runs
    glm::vec2 cursor_{0};
    // Dear ImGui 1.86 knows only the mouse position of the next frame.
    PressPositions pressed_at_;
    int frames_due_ = frames_after_input;
    double last_frame_ = 0;
    std::atomic<bool> woken_{false};
};

Window::~Window() {
    if (backend_ready_)
        ImGui_ImplGlfw_Shutdown();
    gui_.reset();
    if (window_ != nullptr)
        glfwDestroyWindow(window_);
    glfwTerminate();
}

std::string Window::open(const SurfaceOptions& options) {
    glfwSetErrorCallback(note_glfw_error);
    if (!glfwInit())
        return last_glfw_error;
    watch_display();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    const WindowPlace& place = options.place;
    const glm::ivec2 size = options.exact_size ? glm::max(place.size, glm::ivec2(1)) : on_screen(place.size);
    glfwWindowHint(GLFW_MAXIMIZED, place.maximised ? GLFW_TRUE : GLFW_FALSE);
    window_ = glfwCreateWindow(size.x, size.y, options.title.c_str(), nullptr, nullptr);
    if (window_ == nullptr)
        return last_glfw_error;
    if (place.position && is_on_a_screen(*place.position))
        glfwSetWindowPos(window_, place.position->x, place.position->y);
    glfwMakeContextCurrent(window_);
    if (gladLoadGL(glfwGetProcAddress) == 0)
        return "OpenGL cannot be loaded";
    glfwSwapInterval(1);

    float unused = 1;
    glfwGetWindowContentScale(window_, &wanted_scale_, &unused);
    gui_ = std::make_unique<Gui>(wanted_scale_);
    glfwSetWindowUserPointer(window_, this);
    install_callbacks(); // before Dear ImGui's, which call these
    backend_ready_ = ImGui_ImplGlfw_InitForOpenGL(window_, true);
    return backend_ready_ ? "" : "Dear ImGui cannot use the window";
}

void Window::install_callbacks() {
    glfwSetKeyCallback(window_, on_key);
    glfwSetCharCallback(window_, on_character);
    glfwSetWindowFocusCallback(window_, on_focus);
    glfwSetDropCallback(window_, on_drop);
    glfwSetCursorPosCallback(window_, on_cursor);
    glfwSetCursorEnterCallback(window_,
                               [](GLFWwindow* w, int) { // a new window may appear below a mouse that does not move
                                   double x = 0, y = 0;
                                   glfwGetCursorPos(w, &x, &y);
                                   on_cursor(w, x, y);
                               });
    glfwSetMouseButtonCallback(window_, on_button);
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double) { of(w).input_came(); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { of(w).input_came(); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { of(w).input_came(); });
    glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* w, float scale, float) {
        of(w).wanted_scale_ = scale;
        of(w).input_came();
    });
}

void Window::on_key(GLFWwindow* window, int key, int scancode, int action, int mods) {
    Window& self = of(window);
    self.input_came();
    if (self.viewer_ == nullptr)
        return;
    Keyboard& keyboard = self.viewer_->keyboard();
    if (action == GLFW_RELEASE)
        keyboard.release(key_of_glfw(key));
    else if (action == GLFW_PRESS) {
        // The right Alt key is no modifier in X layouts where it is AltGr.
        const bool alt = (mods & GLFW_MOD_ALT) != 0 || glfwGetKey(window, GLFW_KEY_RIGHT_ALT) == GLFW_PRESS;
        keyboard.press(key_of_glfw(key), key_named(key_label(key, scancode), key_of_glfw(key), alt),
                       (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0);
    }
}

void Window::on_character(GLFWwindow* window, unsigned character) {
    Window& self = of(window);
    self.input_came();
    const bool punctuation =
        character > ' ' && character < 127 && key_of_character(static_cast<char>(character)) == Key::none;
    if (self.viewer_ != nullptr && punctuation)
        self.viewer_->keyboard().type(static_cast<char>(character));
}

void Window::on_cursor(GLFWwindow* window, double x, double y) {
    of(window).input_came();
    of(window).cursor_ = {static_cast<float>(x), static_cast<float>(y)};
}

void Window::on_button(GLFWwindow* window, int button, int action, int) {
    Window& self = of(window);
    self.input_came();
    if (action == GLFW_PRESS && button < static_cast<int>(self.pressed_at_.size()))
        self.pressed_at_[static_cast<std::size_t>(button)] = self.cursor_;
}

void Window::on_focus(GLFWwindow* window, int focused) {
    Window& self = of(window);
    self.input_came();
    if (self.viewer_ != nullptr && focused == GLFW_FALSE)
        self.viewer_->keyboard().release_all();
}

void Window::on_drop(GLFWwindow* window, int count, const char** paths) {
    Window& self = of(window);
    self.input_came();
    if (self.viewer_ != nullptr)
        self.viewer_->drop({paths, paths + count});
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::wake() {
    woken_ = true;
    glfwPostEmptyEvent();
}

glm::ivec2 Window::pixels() const {
    glm::ivec2 size;
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

/// Returns when a frame is due or an event arrived: at most 60 frames a second, none while nothing changes.
void Window::wait_until_due(double next_frame_in) {
    const double now = glfwGetTime();
    if (woken_.exchange(false))
        frames_due_ = std::max(frames_due_, 1);
    const double pause = frames_due_ > 0 ? frame_seconds : std::max(next_frame_in, frame_seconds);
    const double left = last_frame_ + pause - now;
    if (left > 0) {
        glfwWaitEventsTimeout(std::min(left, longest_sleep));
        return;
    }
    glfwPollEvents();
    frames_due_ = std::max(frames_due_, 1);
}

void Window::record_place(ViewerState& state) const {
    state.layout.display_scale = std::max(wanted_scale_, Layout::least_ui_scale);
    WindowPlace& place = state.layout.window;
    place.maximised = glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) == GLFW_TRUE;
    if (place.maximised)
        return; // position and size are kept for restoring the window
    glm::ivec2 corner(0), size(0);
    glfwGetWindowPos(window_, &corner.x, &corner.y);
    glfwGetWindowSize(window_, &size.x, &size.y);
    place.position = corner;
    place.size = size;
}

void Window::run(Viewer& viewer, const FrameHooks& hooks) {
    const DisplayLossHandler last_call(hooks.lost);
    viewer_ = &viewer;
    last_frame_ = glfwGetTime() - frame_seconds;
    double took = 0;
    const auto ends = [&] {
        return glfwWindowShouldClose(window_) || viewer.state().wishes.quit || (hooks.ends && hooks.ends());
    };
    while (!ends()) {
        const double before = last_frame_;
        wait_until_due(viewer.next_frame_in());
        const double now = glfwGetTime();
        const glm::ivec2 size = pixels();
        const bool too_early = now - before < frame_seconds;
        if (size.x < 1 || size.y < 1) {
            glfwWaitEventsTimeout(longest_sleep); // minimised
            continue;
        }
        // A script may wait for a frame that no event triggers.
        const bool is_overdue = hooks.before && now - before >= longest_sleep;
        if ((frames_due_ == 0 && !is_overdue) || too_early)
            continue;
        frames_due_ = std::max(frames_due_ - 1, 0);
        last_frame_ = now;
        record_place(viewer.state());
        gui_->set_style(viewer.state().layout.ui_scale(), viewer.state().layout.theme);
        ImGui_ImplGlfw_NewFrame();
        if (hooks.before)
            hooks.before(took);
        gui_->begin_window_frame();
        apply_press_positions(pressed_at_);
        viewer.draw_frame();
        gui_->end_frame();
        if (hooks.after && !hooks.after())
            break;
        glfwSwapBuffers(window_);
        took = glfwGetTime() - now;
    }
    viewer_ = nullptr;
    glfwHideWindow(window_); // background work may take a pass to end
}

} // namespace

std::unique_ptr<Surface> open_window(const SurfaceOptions& options, std::string& error) {
    auto window = std::make_unique<Window>();
    error = window->open(options);
    return error.empty() ? std::move(window) : nullptr;
}

} // namespace tessera
