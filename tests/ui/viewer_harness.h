#pragma once

#include "tests/ui/osmesa_context.h"
#include "ui/gl/gl.h"
#include "ui/gl/gui.h"
#include "ui/viewer/viewer.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace tessera::test {

/// A room with a lamp, seen by a camera.
std::shared_ptr<const Scene> viewer_scene();

/// That room, said to be in a file.
SceneOrigin scene_in(const std::filesystem::path& file);

/// The viewer drawn in memory, driven by synthetic input.
class ViewerHarness {
public:
    /// @param threads  that render: 1 is the session's own
    explicit ViewerHarness(glm::ivec2 size = {1280, 720}, float scale = 1, ViewerOptions options = two_panes(),
                           int threads = 1);

    /// PT and G-PR, of small size.
    static ViewerOptions two_panes();

    void frame(float seconds = 1.0f / 60);
    void frames(int count);
    /// Frames until the condition holds; a test failure after some seconds.
    bool wait_until(const std::function<bool()>& condition);
    /// Loads the scene and waits for both panes' first pictures.
    void load_scene();
    /// Loads the scene and waits until both panes rest at so many samples a pixel: nothing moves any more.
    void rest(int spp);
    /// Until all that is to be saved is written, and told.
    void finish_saving();

    /// Input; each ends with frames in which it takes effect.
    void move_to(glm::vec2 position);
    void press(int button = 0);
    void release(int button = 0);
    void click(glm::vec2 position);
    void click(const std::string& control) { click_at(control, 0.5f); }
    /// Clicks at a fraction of the control's width.
    void click_at(const std::string& control, float fraction);
    void choose(const std::string& control, const std::string& item);
    void drag(glm::vec2 from, glm::vec2 by, int button = 0);
    void wheel(float notches);
    void modifiers(bool ctrl, bool shift);
    void type(Key key, bool ctrl = false, bool shift = false);
    /// Finds the action by its name in the list of commands, and does it.
    void command(std::string_view name);

    void resize(glm::ivec2 size);

    /// Scrolls the side panel until the control is on the screen.
    void reveal(const std::string& control);
    ControlRect place(const std::string& control) const;
    bool has(const std::string& control) const { return viewer.controls().rects().count(control) > 0; }
    ScreenPixels screen() const { return read_screen(context.size()); }
    /// Mean of all channels over a control's area, [0, 255].
    double brightness(const std::string& control) const;
    void save(const std::string& file) const; ///< to look at, if TESSERA_TEST_PICTURES names a folder

    ViewerState& state() { return viewer.state(); }
    const PaneState& pane(int i) { return viewer.state().panes[i]; }

    OsmesaContext context;
    Gui gui;
    float scale_; ///< of the display
    Session session;
    Viewer viewer;
    PictureSaver saver;
};

} // namespace tessera::test
