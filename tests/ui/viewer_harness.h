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

/// Returns a room with a sphere and an area light.
std::shared_ptr<const Scene> viewer_scene();

/// Returns the origin of that room with this file name. The file is not read.
SceneOrigin scene_in(const std::filesystem::path& file);

/// A viewer that draws into memory and is driven by synthetic input.
class ViewerHarness {
public:
    /// @param threads  number of render threads, as in ThreadPool
    explicit ViewerHarness(glm::ivec2 size = {1280, 720}, float scale = 1, ViewerOptions options = two_panes(),
                           int threads = 1);

    /// Returns the options of two panes, PT and G-PR, with 48x36 pixels.
    static ViewerOptions two_panes();

    void frame(float seconds = 1.0f / 60);
    void frames(int count);
    /// Draws frames until the condition holds. After two minutes the test fails.
    bool wait_until(const std::function<bool()>& condition);
    /// Loads the scene and waits for the first complete pass of both panes.
    void load_scene();
    /// Loads the scene and waits until both panes stop at `spp` samples per pixel and nothing moves.
    void rest(int spp);
    /// Waits until all files are saved and reported.
    void finish_saving();

    // Input. Each function ends with frames in which the input takes effect.
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
    /// Runs an action by its name in the command palette.
    void command(std::string_view name);

    void resize(glm::ivec2 size);

    /// Scrolls the side panel until the control is on the screen.
    void reveal(const std::string& control);
    ControlRect place(const std::string& control) const;
    bool has(const std::string& control) const { return viewer.controls().rects().count(control) > 0; }
    ScreenPixels screen() const { return read_screen(context.size()); }
    /// Returns the mean of all channels over a control's area, [0, 255].
    double brightness(const std::string& control) const;
    void save(const std::string& file) const; ///< to the folder TESSERA_TEST_PICTURES, if it is set

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
