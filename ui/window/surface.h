#pragma once

#include "ui/settings/preferences.h"

#include <functional>
#include <memory>
#include <string>

#include <glm/vec2.hpp>

namespace tessera {

constexpr double frame_seconds = 1.0 / 60; ///< at least, from one frame to the next

class Viewer;

/// What is done around each frame.
struct FrameHooks {
    /// Called before it begins, when the window's own input is in: to add some. Gets how long the last one took,
    /// from there until it was shown, seconds. May be empty.
    std::function<void(double last_frame_seconds)> before;
    /// Called after it is drawn and before it is shown; false ends the loop. May be empty.
    std::function<bool()> after;
    /// Asked between frames, at least once a second: true ends the loop. May be empty.
    std::function<bool()> ends;
    /// Called when the display is lost, from the thread of run(): the last that is done. May be empty.
    std::function<void()> lost;
};

/// What the process ends with when its display is lost (the server ended, or the connection to it).
inline constexpr int display_lost = 3;

struct SurfaceOptions {
    std::string title = "Tessera";
    WindowPlace place{{1440, 810}, {}, false};
    bool exact_size = false; ///< keep its size even if the screen is smaller
};

/// Something that a viewer is drawn on, with its OpenGL context and Dear ImGui. The viewer must end before it.
class Surface {
public:
    virtual ~Surface() = default;

    /// Draws frames when they are due, and sleeps between them, until the user quits or a hook says so. What a
    /// hook throws goes through. A lost display ends the process, see display_lost.
    virtual void run(Viewer& viewer, const FrameHooks& hooks) = 0;
    /// Makes run() draw a frame soon. From any thread.
    virtual void wake() = 0;
    /// What the window is called. To be called from the thread of run().
    virtual void set_title(const std::string& title) = 0;
    /// The size of the framebuffer, pixels.
    virtual glm::ivec2 pixels() const = 0;
};

/// A window on the screen. Null, and why in `error`, where there is no display or no OpenGL 3.3.
std::unique_ptr<Surface> open_window(const SurfaceOptions& options, std::string& error);

/// A place in memory to draw into, by EGL without a display. Takes no input. Null, and why in `error`, where that
/// is not offered.
std::unique_ptr<Surface> open_offscreen(const SurfaceOptions& options, std::string& error);

} // namespace tessera
