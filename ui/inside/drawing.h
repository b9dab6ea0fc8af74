#pragma once

#include "render/inspect/inspection.h"
#include "render/scene/camera.h"
#include "ui/gl/image_view.h"
#include "ui/gl/theme.h"
#include "ui/gl/tone.h"

#include <string>
#include <vector>

#include <imgui.h>

namespace tessera {

/// Draws pixels of an image over its picture, into the current window.
class SetDrawing {
public:
    SetDrawing(const PictureFrame& frame, glm::ivec2 image_size) : frame_(frame), size_(image_size) {}

    float unit() const; ///< edge of a pixel, screen units
    ImVec2 corner(glm::ivec2 pixel) const;
    ImVec2 middle(glm::ivec2 pixel) const;

    void fill(glm::ivec2 pixel, ImU32 colour) const;
    void fill(PixelRect rect, ImU32 colour) const;
    /// The edges of one pixel, within it.
    void frame(glm::ivec2 pixel, ImU32 colour, float width) const;
    void outline(PixelRect rect, ImU32 colour, float width) const;
    /// Draws a line around all pixels of the set that are its border, or all that are not.
    void outline(const InspectedSet& set, bool border, ImU32 colour, float width) const;
    /// An arrow from one pixel's middle toward another's, over a share of the way.
    void arrow(glm::ivec2 from, glm::ivec2 to, float share, ImU32 colour, float width) const;

private:
    const PictureFrame& frame_;
    glm::ivec2 size_;
};

namespace set_colours {
inline constexpr ImU32 inner = IM_COL32(64, 196, 178, 255), border = IM_COL32(255, 168, 51, 255);
}

/// Draws lines and points of the scene, as a camera sees them, into the current window.
class SceneLines {
public:
    /// @param size        pixels of the camera's picture, which lies in the frame
    /// @param least_depth what lies nearer is not drawn, units of the scene
    /// @param lens        the point of the lens that it is seen through, in radii
    SceneLines(const PictureFrame& frame, const Camera& camera, glm::ivec2 size, float least_depth,
               glm::vec2 lens = glm::vec2(0));

    void line(glm::vec3 from, glm::vec3 to, ImU32 colour, float width) const;
    /// A line with dark edges, plain on bright pictures, too.
    void outlined_line(glm::vec3 from, glm::vec3 to, ImU32 colour, float width) const;
    void point(glm::vec3 p, ImU32 colour, float radius) const;
    /// A small square, without an edge: for thousands of them.
    void dot(glm::vec3 p, ImU32 colour, float width) const;
    /// Writes the text beside the point.
    void name(glm::vec3 p, const std::string& text, ImU32 colour) const;

private:
    glm::vec4 project(glm::vec3 point) const { return projection_.project(point, lens_); }
    ImVec2 on_screen(glm::vec4 projected) const;

    const PictureFrame& frame_;
    Projection projection_;
    glm::ivec2 size_;
    float least_depth_;
    glm::vec2 lens_;
};

/// The colour that stands for how the shift ended; grey where it was not tried.
ImU32 outcome_colour(const InspectedShift& shift);

/// Draws shifted paths in the colours of their outcomes; the more of the light one brings, the plainer it is.
/// @param marked  the one that stands out; -1: none does
void draw_shifts(const SceneLines& lines, const std::vector<const InspectedShift*>& shifts, int marked);

/// Draws a base path in white with its vertices' names, its light samples in yellow, and its footprints in violet.
/// @param far  how long a way to infinity is drawn, units of the scene
void draw_base_path(const SceneLines& lines, const std::vector<InspectedVertex>& path, float far);

} // namespace tessera
