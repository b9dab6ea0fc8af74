#pragma once

#include "ui/settings/preferences.h"

#include <functional>
#include <memory>
#include <string>

#include <glm/vec2.hpp>

namespace tessera {

constexpr double frame_seconds = 1.0 / 60; ///< shortest time from one frame to the next

class Viewer;

/// Functions that are called around each frame. Each may be empty.
struct FrameHooks {
    /// Called before a frame begins, after the window's own input, to add input. Gets the duration of the last
    /// frame, from this call until it was shown, in seconds.
    std::function<void(double last_frame_seconds)> before;
    /// Called after a frame is drawn and before it is shown; false ends the loop.
    std::function<bool()> after;
    /// Called between frames, at least once a second; true ends the loop.
    std::function<bool()> ends;
    /// Called last when the display is lost, from the thread of run().
    std::function<void()> lost;
};

/// Exit code of the process when its display is lost (the server ended, or the connection to it).
inline constexpr int display_lost = 3;

struct SurfaceOptions {
    std::string title = "Tessera";
    WindowPlace place{{1440, 810}, {}, false};
    bool exact_size = false; ///< keep the size even if the screen is smaller
};

/// A surface that a viewer is drawn on, with its OpenGL context and Dear ImGui. It must outlive the viewer.
class Surface {
public:
    virtual ~Surface() = default;

    /// Draws frames when they are due, and sleeps between them, until the user quits or a hook ends the loop.
    /// Exceptions of hooks pass through. A lost display ends the process, see display_lost.
    virtual void run(Viewer& viewer, const FrameHooks& hooks) = 0;
    /// Makes run() draw a frame soon. May be called from any thread.
    virtual void wake() = 0;
    /// Sets the window's title. Must be called from the thread of run().
    virtual void set_title(const std::string& title) = 0;
    /// Returns the size of the framebuffer in pixels.
    virtual glm::ivec2 pixels() const = 0;
};

/// Opens a window on the screen. Returns null, with the reason in `error`, if there is no display or no
/// OpenGL 3.3.
std::unique_ptr<Surface> open_window(const SurfaceOptions& options, std::string& error);

/// Opens a framebuffer in memory, by EGL without a display. It takes no input. Returns null, with the reason in
/// `error`, if EGL does not support this.
std::unique_ptr<Surface> open_offscreen(const SurfaceOptions& options, std::string& error);

} // namespace tessera
