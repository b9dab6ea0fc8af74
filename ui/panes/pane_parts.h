#pragma once

#include "render/session/snapshot.h"
#include "ui/gl/canvas.h"
#include "ui/gl/controls.h"
#include "ui/gl/image_view.h"
#include "ui/panes/showing.h"
#include "ui/state/actions.h"
#include "ui/state/viewer_state.h"

#include <optional>
#include <span>
#include <string>

#include <glm/vec3.hpp>

namespace tessera {

/// Objects with which pane views draw.
struct PaneTools {
    const CanvasShader& shader;
    const PaneImages& images;
    Controls& controls;
    ViewerState& state;
};

/// Returns "raw samples", "raw samples, L2" where the raw gradients are reconstructed, or "denoised".
std::string sample_label(const PaneSettings& pane);

/// Draws the strip above a pane's picture: its method with what distinguishes it from the other panes, its
/// buffer, and the button that switches its denoiser.
void draw_pane_header(int index, Controls& controls, ViewerState& state);

/// Returns the text of the line below a picture: method and difference from the other panes, state, samples per
/// pixel, seconds, rays per second, error, reconstruction with its solver's steps and time or its progress, the
/// fraction of radiance that firefly suppression redistributed, and the number of invalid samples.
std::string status_text(const ViewerState& state, int pane);
/// Returns the tooltip of that line: one labelled line per number.
std::string status_help(const ViewerState& state, int pane);

/// Returns "equal time: waiting for pane 2 (190 of 600 s)" while another pane catches up; empty: the pane does
/// not wait.
std::string waiting_text(const ViewerState& state, int pane);

/// Returns a buffer's value as text: "0.123 0.456 0.789  Y 0.4", "12.5 paths per pass".
std::string value_text(const Rgb& value, ColourMap map, const BufferInfo& about);

/// Returns pixel and value at the cursor; empty: there is none. For a preview, the pixel is one of the full size.
std::string cursor_text(const ViewerState& state, const PaneImages& images, int pane);
/// Returns the meaning and unit of the values at the cursor.
std::string cursor_help(const Showing& showing, const ViewerState& state);

/// Draws status and cursor text in a line. The cursor text covers the end of a long status.
void draw_status(const std::string& id, int pane, const ViewerState& state, const PaneImages& images,
                 Controls& controls);

/// Returns the value with up to three digits, as many as fit seven characters: "0.0123", "-1e-05".
std::string short_number(float value);

/// Draws the value of each pixel into it, in the unit of the status line, if pixels are large enough. Returns
/// whether they are.
bool draw_pixel_numbers(const PictureFrame& frame, int pane, const ViewerState& state, const PaneImages& images);

/// Returns the view of the magnifier: a square, enlarged around a place of the image.
/// @param place   fractions of the image
/// @param pixels  edge of the square, framebuffer pixels
CanvasView magnified(const CanvasView& view, glm::ivec2 image_size, glm::vec2 place, int pixels);

/// Returns the length of the magnifier's edges, framebuffer pixels.
int magnifier_pixels(const PictureFrame& frame);

/// Draws the magnifier's rendition over the picture, around a place of the image, with a frame around its pixel.
void draw_magnifier(const PictureFrame& frame, const CanvasView& view, glm::ivec2 image_size, glm::vec2 place,
                    GLuint rendition);

/// State of the mouse over a pane's picture in a frame. Positions are pixels from the pane's upper left corner.
struct PaneMouse {
    glm::vec2 position{0};
    glm::vec2 previous{0}; ///< position in the previous frame
    float wheel = 0;       ///< notches, up is positive
    bool left = false;     ///< held since a press over this pane; likewise middle and right
    bool middle = false;
    bool right = false;
    bool ctrl = false;
    bool shift = false;
};

/// Moves the camera or the picture.
/// @param placement  of the picture in the pane
void apply_mouse(const PaneMouse& mouse, const Placement& placement, glm::ivec2 image_size, glm::ivec2 pane_size,
                 ViewerState& state);

/// Returns the position of the mouse, screen units.
glm::vec2 mouse_position();

/// Returns where a mouse button was pressed in this frame, or else the position of the mouse, screen units. In a
/// slow frame the mouse can move before and after the press.
glm::vec2 grab_position();

/// Returns the state of the mouse over the last item, which must be the picture of `frame`.
PaneMouse read_mouse(const PictureFrame& frame);

/// Returns the surface point that the camera sees at a place of the pane, pixels; empty: none.
std::optional<glm::vec3> point_under(glm::vec2 place, const PictureFrame& frame, const ViewerState& state);

/// Returns the names of the actions in a pane's menu; null: a separator.
std::span<const char* const> pane_menu_items();

/// Draws a menu item that runs the action, and registers it as "MENU/name".
void draw_menu_item(const std::string& menu, const Action& action, Controls& controls, ViewerState& state);

/// Draws the menu of a pane, which a right click without a drag opens over its picture. To be called after the
/// picture's item.
void draw_pane_menu(int pane, const PictureFrame& frame, bool is_click, PaneTools& tools);

/// Whether a screen point is near enough to the wipe's line to drag it.
bool is_on_wipe(const PictureFrame& frame, float wipe, glm::vec2 point);

/// Draws the wipe's line with its handle and a label on each side; without a wipe, one label in the middle if the
/// pane does not show its own picture. To be called after the picture's item.
/// @param id  of the pane
void draw_comparison(const PictureFrame& frame, const std::string& id, int pane, const ViewerState& state,
                     Controls& controls);

/// Draws the reuse sets of the snapshot's newest pass over a picture: the grid of tiles, their splits, and the
/// sampling sets of the pixel at `place` with their borders. To be called within the pane's window.
/// @param clip   the part of the screen to draw on
/// @param place  fractions of the image; empty: no set is marked
void draw_tiles(const PictureFrame& frame, const ScreenRect& clip, const Snapshot& snapshot,
                std::optional<glm::vec2> place);

} // namespace tessera
