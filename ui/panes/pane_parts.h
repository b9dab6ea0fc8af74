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

/// What pane views draw with.
struct PaneTools {
    const CanvasShader& shader;
    const PaneImages& images;
    Controls& controls;
    ViewerState& state;
};

/// Returns "raw samples", "raw samples, L2" where the raw gradients are reconstructed, or "denoised".
std::string sample_label(const PaneSettings& pane);

/// Draws the strip above a pane's picture: its method with what distinguishes it from the other panes, its buffer,
/// and the button that switches its denoiser.
void draw_pane_header(int index, Controls& controls, ViewerState& state);

/// Returns the text of the line below a picture: method, difference from the other panes, reason to rest, samples
/// per pixel, seconds, rays per second, and the reconstruction with its solver's steps and time, or its progress.
/// The share of radiance that firefly suppression redistributed follows if there is any.
std::string status_text(const ViewerState& state, int pane);

/// "waiting for pane 2 (3:10 of 10:00)": another pane catches up with what this one has had. Empty: it does not
/// wait.
std::string waiting_text(const ViewerState& state, int pane);

/// A buffer's number: "0.123 0.456 0.789  Y 0.4", "12.5 paths a pass".
std::string value_text(const Rgb& value, ColourMap map, const BufferInfo& about);

/// Pixel and number at the cursor in what the pane shows; empty where there is none. Of a first look, too, the
/// pixel is one of the size that is asked for.
std::string cursor_text(const ViewerState& state, const PaneImages& images, int pane);
/// What the numbers at the cursor are, and their unit.
std::string cursor_help(const Showing& showing, const ViewerState& state);

/// Draws status and cursor in a line, in which the status gives way.
void draw_status(const std::string& id, int pane, const ViewerState& state, const PaneImages& images,
                 Controls& controls);

/// The value with as many of three digits as seven characters have room for: "0.0123", "-1e-05".
std::string short_number(float value);

/// Writes the value of each pixel into it, in the unit that the status line shows, where pixels are large enough
/// to read it. Tells whether they are.
bool draw_pixel_numbers(const PictureFrame& frame, int pane, const ViewerState& state, const PaneImages& images);

/// How the picture lies in a square of so many framebuffer pixels when enlarged about a place of the image, which
/// is fractions of it.
CanvasView magnified(const CanvasView& view, glm::ivec2 image_size, glm::vec2 place, int pixels);

/// The length of the magnifier's edges, framebuffer pixels.
int magnifier_pixels(const PictureFrame& frame);

/// Draws the magnifier's rendition over the picture, about a place of the image, with a frame around its pixel.
void draw_magnifier(const PictureFrame& frame, const CanvasView& view, glm::ivec2 image_size, glm::vec2 place,
                    GLuint rendition);

/// The mouse over one pane's picture in one frame; positions in pixels of the pane from its top left.
struct PaneMouse {
    glm::vec2 position{0};
    glm::vec2 previous{0}; ///< in the frame before
    float wheel = 0;       ///< notches, up is positive
    bool left = false;     ///< held, having gone down over this pane
    bool middle = false;
    bool right = false;
    bool ctrl = false;
    bool shift = false;
};

/// Moves the camera or the picture. `placement` is where the picture of `image_size` pixels lies in the pane.
void apply_mouse(const PaneMouse& mouse, const Placement& placement, glm::ivec2 image_size, glm::ivec2 pane_size,
                 ViewerState& state);

/// Where the mouse is, screen units.
glm::vec2 mouse_position();

/// Where a button of the mouse went down in this frame, or else where the mouse is. In a slow frame it may have
/// come from elsewhere before that, and gone on after.
glm::vec2 grab_position();

/// The mouse over the item just drawn, which is the picture of `frame`.
PaneMouse read_mouse(const PictureFrame& frame);

/// What the camera sees at a place of the pane, pixels; empty: nothing.
std::optional<glm::vec3> point_under(glm::vec2 place, const PictureFrame& frame, const ViewerState& state);

/// What is most asked for of a picture: names of actions; null: a line between groups.
std::span<const char* const> pane_menu_items();

/// An item of a menu that runs the action, noted as "MENU/name".
void draw_menu_item(const std::string& menu, const Action& action, Controls& controls, ViewerState& state);

/// The menu of a pane, which a click of the right button opens over its picture, but not a drag. To be called
/// after the item that the picture is.
void draw_pane_menu(int pane, const PictureFrame& frame, bool is_click, PaneTools& tools);

/// Whether a point of the screen is near enough to the line to take hold of it.
bool is_on_wipe(const PictureFrame& frame, float wipe, glm::vec2 point);

/// Draws the line with its handle and a label at each side; without a line, one label in the middle. `id` of the
/// pane. To be called after the item that the picture is.
void draw_comparison(const PictureFrame& frame, const std::string& id, int pane, const ViewerState& state,
                     Controls& controls);

/// Draws over a picture which pixels share their light in the snapshot's newest pass: the grid of tiles, what they
/// are cut into, and about one place the whole sampling set with its border. To be called within the pane's
/// window.
/// @param clip  the part of the screen to draw on
/// @param place fractions of the image; empty: no set is marked
void draw_tiles(const PictureFrame& frame, const ScreenRect& clip, const Snapshot& snapshot,
                std::optional<glm::vec2> place);

} // namespace tessera
