#include "ui/gl/gl.h"
#include "ui/gl/gui.h"
#include "ui/viewer/viewer.h"
#include "ui/window/surface.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <glm/common.hpp>

namespace tessera {

namespace {

/// An OpenGL 3.3 context that needs neither display nor surface (EGL_PLATFORM_SURFACELESS_MESA).
class EglContext {
public:
    ~EglContext() {
        if (display_ == EGL_NO_DISPLAY)
            return;
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT)
            eglDestroyContext(display_, context_);
        eglTerminate(display_);
    }

    /// Creates the context and makes it current. Returns an error message; empty: success.
    std::string open() {
        display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr))
            return "EGL has no display in memory (EGL_PLATFORM_SURFACELESS_MESA)";
        if (!eglBindAPI(EGL_OPENGL_API))
            return "EGL does not support OpenGL";
        const EGLint config_attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglChooseConfig(display_, config_attributes, &config, 1, &count) || count == 0)
            return "EGL has no configuration for OpenGL";
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     3,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     3,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
        context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes);
        if (context_ == EGL_NO_CONTEXT || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            return "EGL cannot create an OpenGL 3.3 context";
        if (gladLoadGL(reinterpret_cast<GLADloadfunc>(eglGetProcAddress)) == 0)
            return "OpenGL cannot be loaded";
        return {};
    }

private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

class Offscreen final : public Surface {
public:
    std::string open(const SurfaceOptions& options) {
        size_ = glm::max(options.place.size, glm::ivec2(1));
        std::string error = context_.open();
        if (!error.empty())
            return error;
        gui_ = std::make_unique<Gui>(Layout::least_ui_scale);
        target_.resize(size_);
        return {};
    }

    void run(Viewer& viewer, const FrameHooks& hooks) override {
        const DrawInto drawing(target_);
        auto last = std::chrono::steady_clock::now();
        double took = 0;
        while (!viewer.state().wishes.quit && !(hooks.ends && hooks.ends())) {
            const auto now = std::chrono::steady_clock::now();
            if (hooks.before)
                hooks.before(took);
            viewer.state().layout.display_scale = Layout::least_ui_scale;
            gui_->set_style(viewer.state().layout.ui_scale(), viewer.state().layout.theme);
            gui_->begin_frame(glm::vec2(size_), 1.0f, std::chrono::duration<float>(now - last).count());
            last = now;
            viewer.draw_frame();
            gui_->end_frame();
            if (hooks.after && !hooks.after())
                return;
            glFinish(); // no display waits for the frame
            took = std::chrono::duration<double>(std::chrono::steady_clock::now() - now).count();
            std::this_thread::sleep_for(
                std::chrono::duration<double>(frame_seconds - took)); // same rate as a window
            sleep(frames_ < 3 ? 0 : std::min(viewer.next_frame_in(), 0.5));
            ++frames_;
        }
    }

    void wake() override {
        {
            const std::lock_guard lock(mutex_);
            woken_ = true;
        }
        wake_.notify_one();
    }

    void set_title(const std::string&) override {}
    glm::ivec2 pixels() const override { return size_; }

private:
    void sleep(double seconds) {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return woken_; });
        woken_ = false;
    }

    EglContext context_; // first, as the objects of the others live in it
    glm::ivec2 size_{1};
    std::unique_ptr<Gui> gui_;
    Framebuffer target_;
    int frames_ = 0;

    std::mutex mutex_;
    std::condition_variable wake_;
    bool woken_ = false;
};

} // namespace

std::unique_ptr<Surface> open_offscreen(const SurfaceOptions& options, std::string& error) {
    auto surface = std::make_unique<Offscreen>();
    error = surface->open(options);
    return error.empty() ? std::move(surface) : nullptr;
}

} // namespace tessera
