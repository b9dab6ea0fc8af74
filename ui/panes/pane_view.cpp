#include "ui/panes/pane_view.h"

#include "render/inspect/inspection.h"
#include "render/scene/scene.h"
#include "ui/gl/gui.h"
#include "ui/gl/theme.h"
#include "ui/inside/inside.h"
#include "ui/panes/pane_parts.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <imgui.h>

namespace tessera {

namespace {

constexpr ImGuiWindowFlags pane_flags =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav |
    ImGuiWindowFlags_NoBackground; // Gui clears the screen in the panels' colour

/// Draws text in the middle of an area without a picture, wrapped to its width.
void draw_notice(const ScreenRect& where, const std::string& text) {
    const float width = where.size().x - ImGui::GetFontSize();
    if (text.empty() || width < ImGui::GetFontSize())
        return;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
    const glm::vec2 at = (where.min + where.max - glm::vec2(size.x, size.y)) * 0.5f;
    ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), {at.x, at.y},
                                        colours::overlay_dim_text, text.c_str(), nullptr, width);
}

/// Returns the areas to the left and to the right of a wipe's line.
std::array<ScreenRect, 2> side_rects(const PictureFrame& frame, const ViewerState& state) {
    const float middle = std::floor(glm::mix(frame.rect.min.x, frame.rect.max.x, state.layout.wipe));
    return {{{frame.rect.min, {middle, frame.rect.max.y}}, {{middle, frame.rect.min.y}, frame.rect.max}}};
}

/// Returns the text to show in place of a missing or black picture; empty: none.
std::string notice_of(const Showing& showing, const PaneTools& tools) {
    const ViewerState& state = tools.state;
    if (const std::string missing = missing_text(showing, state); !missing.empty() || !state.scene)
        return missing;
    if (showing.pane == the_reference)
        return "";
    const PaneState& pane = state.panes[showing.pane];
    if (pane.failed)
        return "The render failed: " + pane.failure +
               "\n\nPress R to restart it, or change size, settings or scene.";
    const bool is_done = pane.snapshot && pane.snapshot->generation == pane.generation && !pane.snapshot->coarse();
    if (!is_done || showing.subtrahend >= 0 || !tools.images[showing.pane].is_black())
        return "";
    if (state.scene->triangle_count() + state.scene->quadric_count() == 0)
        return "The scene is empty: nothing in it has a surface.";
    return "The camera sees no light.\n\nHome returns to the camera of the scene file. The buffer Albedo shows "
           "the surfaces without light.";
}

std::string pane_id(int index) {
    return "pane" + std::to_string(index);
}

const PaneImage& image_of(const Showing& showing, const PaneTools& tools) {
    return tools.images[showing.pane];
}

CanvasView view_of(const Showing& showing, const PictureFrame& frame, const PaneTools& tools) {
    CanvasView view = colours_of(showing, tools.state, tools.images);
    view.pane_size = frame.pixels;
    view.image_origin = frame.placement.origin;
    view.image_extent = frame.placement.extent;
    return view;
}

} // namespace

void PaneView::take_input(int index, const ScreenRect& where, PaneTools& tools) {
    const std::string id = pane_id(index);
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    const float pad = std::floor(ImGui::GetFontSize() * 0.3f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, pad});
    ImGui::Begin(id.c_str(), nullptr, pane_flags);
    ImGui::PopStyleVar();
    draw_pane_header(index, tools.controls, tools.state);
    frame_ = place_picture(index, id, tools);
    use_mouse(index, frame_, tools);
    ImGui::End();
}

void PaneView::draw(int index, PaneTools& tools) {
    const std::string id = pane_id(index);
    ImGui::Begin(id.c_str(), nullptr, pane_flags); // continues the window of take_input()
    frame_.placement = tools.state.display.view.place(tools.state.request_size(), frame_.pixels);
    draw_renditions(index, frame_, tools);
    draw_overlays(index, id, frame_, tools);
    draw_status(id, index, tools.state, tools.images, tools.controls);
    ImGui::End();
}

/// Makes the item of the picture, which fills the pane except for the status line.
PictureFrame PaneView::place_picture(int index, const std::string& id, PaneTools& tools) {
    PictureFrame frame;
    frame.pixels_a_unit = ImGui::GetIO().DisplayFramebufferScale.x;
    const ImVec2 min = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    const float status_height = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().ItemSpacing.y;
    const glm::vec2 size = glm::max(glm::floor(glm::vec2(room.x, room.y - status_height)), glm::vec2(1));
    frame.rect = {{min.x, min.y}, glm::vec2(min.x, min.y) + size};
    frame.pixels = glm::max(glm::ivec2(size * frame.pixels_a_unit), glm::ivec2(1));
    tools.state.panes[index].canvas_size = frame.pixels;
    frame_tile(index, frame, tools.state);
    frame.placement = tools.state.display.view.place(tools.state.request_size(), frame.pixels);
    ImGui::InvisibleButton((id + ".picture").c_str(), {size.x, size.y},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle |
                               ImGuiButtonFlags_MouseButtonRight);
    tools.controls.place((id + ".picture").c_str(), nullptr);
    return frame;
}

/// Zooms the picture once to the slow motion's tile.
void PaneView::frame_tile(int index, const PictureFrame& frame, ViewerState& state) {
    SlowMotion& slow = state.slow_motion;
    if (!slow.frames || !shows_slow_motion(index, state))
        return;
    slow.frames = false;
    if (!slow.view_before)
        slow.view_before = state.display.view;
    const PixelRect& t = slow.tile->tile; // with its border and a margin of 0.75 pixels
    const glm::vec2 image(state.request_size());
    const glm::vec2 min = (glm::vec2(t.x0, t.y0) - 0.75f) / image, max = (glm::vec2(t.x1, t.y1) + 1.75f) / image;
    state.display.view.show(min, max, state.request_size(), frame.pixels);
}

// --- the mouse ---

void PaneView::use_mouse(int index, PictureFrame& frame, PaneTools& tools) {
    ViewerState& state = tools.state;
    if (ImGui::IsItemActivated()) {
        state.active_pane = index;
        grip_ = grip_at(index, frame, tools);
        if (grip_.range && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
            state.display.ranges.erase(grip_.range->buffer); // back to the automatic range
            grip_ = grip_at(index, frame, tools);
        }
    }
    PaneMouse mouse = read_mouse(frame);
    const Grip hold = ImGui::IsItemActive() ? grip_ : grip_at(index, frame, tools);
    if (ImGui::IsItemHovered() && !hold.is_camera())
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    else if (ImGui::IsItemHovered() && (state.inspector.active || state.slow_motion.active))
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand); // a click chooses a pixel
    if (ImGui::IsItemActive() && !grip_.is_camera()) {
        drag(frame, state);
        mouse.left = mouse.middle = mouse.right = false; // only the wheel keeps working
    }
    if ((state.inspector.active || state.slow_motion.active) && mouse.left && !mouse.ctrl && !mouse.shift) {
        // A new tile moves the picture under the mouse, so a held button must not choose again.
        if (!state.slow_motion.active || ImGui::IsItemActivated())
            choose_sample(index, frame, state);
        mouse.left = false;
    }
    take_hold(mouse, frame, state);
    draw_pane_menu(index, frame, !has_moved_, tools);
    const glm::ivec2 image_size = state.request_size();
    apply_mouse(mouse, frame.placement, image_size, frame.pixels, state);
    frame.placement = state.display.view.place(image_size, frame.pixels);

    if (ImGui::IsItemHovered())
        state.layout.cursor = {index, frame.to_image(mouse_position()),
                               (mouse_position().x - frame.rect.min.x) / frame.rect.size().x};
    else if (state.layout.cursor && state.layout.cursor->pane == index)
        state.layout.cursor.reset();
}

/// Sets the centre of a drag to the surface under the mouse, so that an orbit inside a room does not pass through
/// its walls. A double click turns the camera to the surface.
void PaneView::take_hold(const PaneMouse& mouse, const PictureFrame& frame, ViewerState& state) {
    if (ImGui::IsItemActivated()) {
        has_hold_ = has_moved_ = false;
        is_double_ = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && grip_.is_camera() && mouse.left &&
                     !mouse.ctrl && !mouse.shift;
    }
    has_moved_ = has_moved_ || mouse.position != mouse.previous;
    const bool looks = ImGui::IsItemDeactivated() && is_double_ && !has_moved_;
    const bool drags = (mouse.left || mouse.middle || mouse.right) && !mouse.ctrl && has_moved_ && !has_hold_;
    if (!looks && !drags)
        return;
    has_hold_ = true;
    const std::optional<glm::vec3> point = point_under(mouse.previous, frame, state);
    if (point && looks)
        state.camera.focus(*point);
    else if (point)
        state.camera.grab(*point);
}

/// Chooses the pixel under the mouse for the path inspector or the slow motion.
void PaneView::choose_sample(int index, const PictureFrame& frame, ViewerState& state) {
    const glm::vec2 at = grab_position(), place = frame.to_image(at);
    if (place.x < 0 || place.y < 0 || place.x >= 1 || place.y >= 1)
        return;
    const float share = (at.x - frame.rect.min.x) / frame.rect.size().x;
    const int shown = showing_at(state, index, share).pane;
    const auto slot_of = [&](int pane) { return state.panes[pane].slot; };
    const glm::ivec2 pixel(place * glm::vec2(state.request_size()));
    if (state.slow_motion.active)
        state.slow_motion.start({slot_of(index), pixel, {}});
    else
        state.inspector.choose({slot_of(shown == the_reference ? index : shown), pixel, {}});
}

PaneView::Grip PaneView::grip_at(int index, const PictureFrame& frame, PaneTools& tools) const {
    const glm::vec2 point = grab_position();
    Grip grip;
    grip.range = legends_.held_at(point, tools);
    if (!grip.range && sides_of(tools.state, index).divided() && is_on_wipe(frame, tools.state.layout.wipe, point))
        grip.wipe = point.x - glm::mix(frame.rect.min.x, frame.rect.max.x, tools.state.layout.wipe);
    return grip;
}

/// Moves the held line or range to the mouse. Absolute positions avoid an offset after overshooting an end.
void PaneView::drag(const PictureFrame& frame, ViewerState& state) const {
    const float x = mouse_position().x;
    if (grip_.wipe)
        state.layout.wipe = std::clamp((x - *grip_.wipe - frame.rect.min.x) / frame.rect.size().x, 0.0f, 1.0f);
    else if (x != grip_.range->from || state.display.ranges.count(grip_.range->buffer) > 0)
        state.display.ranges[grip_.range->buffer] = grip_.range->at(x);
}

// --- the picture ---

void PaneView::draw_renditions(int index, const PictureFrame& frame, PaneTools& tools) {
    const Sides sides = sides_of(tools.state, index);
    const ImVec2 min(frame.rect.min.x, frame.rect.min.y), max(frame.rect.max.x, frame.rect.max.y);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto draw = [&](Canvas& canvas, const Showing& showing) {
        const ShowingTextures textures = textures_of(showing, tools.images);
        const GLuint rendition =
            canvas.draw(tools.shader, textures.image, view_of(showing, frame, tools), textures.subtrahend);
        list.AddImage(texture_id(rendition), min, max, {0, 1}, {1, 0});
    };
    draw(canvas_, sides.left);
    if (!sides.divided())
        return;
    const ScreenRect right = side_rects(frame, tools.state)[1];
    list.PushClipRect({right.min.x, right.min.y}, {right.max.x, right.max.y}, true);
    draw(right_canvas_, sides.right);
    list.PopClipRect();
}

void PaneView::draw_overlays(int index, const std::string& id, const PictureFrame& frame, PaneTools& tools) {
    ViewerState& state = tools.state;
    draw_shared(index, frame, state);
    if (!shows_slow_motion(index, state)) // which draws its own numbers
        draw_pixel_numbers(frame, index, state, tools.images);
    draw_comparison(frame, id, index, state, tools.controls);
    draw_missing(index, frame, tools);
    legends_.draw(frame, id, index, tools);
    draw_mode(frame, id, tools);
    if (state.display.magnifier)
        draw_magnifier_at_cursor(index, frame, tools);
    draw_active_frame(index, frame, state);
}

/// Draws notice_of() on each side of a wipe's line.
void PaneView::draw_missing(int index, const PictureFrame& frame, const PaneTools& tools) {
    const Sides sides = sides_of(tools.state, index);
    if (!sides.divided())
        return draw_notice(frame.rect, notice_of(sides.left, tools));
    const auto rects = side_rects(frame, tools.state);
    draw_notice(rects[0], notice_of(sides.left, tools));
    draw_notice(rects[1], notice_of(sides.right, tools));
}

/// Draws tiles, inspected paths and slow motion on each side of a wipe's line.
void PaneView::draw_shared(int index, const PictureFrame& frame, const ViewerState& state) {
    const Sides sides = sides_of(state, index);
    const auto draw = [&](const Showing& showing, const ScreenRect& clip) {
        if (showing.pane == the_reference)
            return;
        const auto& snapshot = state.panes[showing.pane].snapshot;
        if (state.display.show_tiles && snapshot)
            draw_tiles(frame, clip, *snapshot,
                       state.layout.cursor ? std::optional(state.layout.cursor->place) : std::nullopt);
        draw_inspected_paths(frame, clip, showing.pane, state);
        draw_slow_motion(frame, clip, showing.pane, state);
    };
    if (!sides.divided())
        return draw(sides.left, frame.rect);
    const auto rects = side_rects(frame, state);
    draw(sides.left, rects[0]);
    draw(sides.right, rects[1]);
}

/// Draws a frame around the active one of several panes.
void PaneView::draw_active_frame(int index, const PictureFrame& frame, const ViewerState& state) {
    const ScreenRect& rect = frame.rect;
    if (index == state.active_pane && state.panes.size() > 1 && !state.layout.alone)
        ImGui::GetWindowDrawList()->AddRect({rect.min.x, rect.min.y}, {rect.max.x, rect.max.y}, colours::accent);
}

/// Draws a label while the left mouse button chooses a pixel or tile instead of moving the camera.
void PaneView::draw_mode(const PictureFrame& frame, const std::string& id, PaneTools& tools) {
    const ViewerState& state = tools.state;
    if (!state.inspector.active && !state.slow_motion.active)
        return;
    const std::string text = state.slow_motion.active ? "Slow motion: click a tile (J or Esc to end)"
                                                      : "Path inspector: click a pixel (I or Esc to end)";
    const float pad = std::floor(ImGui::GetFontSize() * 0.4f);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    if (size.x + 4 * pad > frame.rect.size().x || size.y + 4 * pad > frame.rect.size().y)
        return;
    const ImVec2 min(frame.rect.min.x + pad, frame.rect.min.y + pad);
    const ImVec2 max(min.x + size.x + 2 * pad, min.y + size.y + pad);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, colours::overlay, pad * 0.5f);
    list.AddText({min.x + pad, min.y + pad * 0.5f}, colours::overlay_accent, text.c_str());
    tools.controls.place_rect((id + ".mode").c_str(), {min.x, min.y}, {max.x, max.y});
}

void PaneView::draw_magnifier_at_cursor(int index, const PictureFrame& frame, PaneTools& tools) {
    if (!tools.state.layout.cursor)
        return;
    const Showing showing = showing_at(tools.state, index, tools.state.layout.cursor->share);
    const PaneImage& image = image_of(showing, tools);
    const glm::vec2 place = tools.state.layout.cursor->place;
    if (image.empty() || !value_at(showing, tools.images, place))
        return;
    const glm::ivec2 size(image.pixels().width(), image.pixels().height());
    const CanvasView view = magnified(view_of(showing, frame, tools), size, place, magnifier_pixels(frame));
    const ShowingTextures textures = textures_of(showing, tools.images);
    const GLuint rendition = magnifier_canvas_.draw(tools.shader, textures.image, view, textures.subtrahend);
    draw_magnifier(frame, view, size, place, rendition);
}

} // namespace tessera
