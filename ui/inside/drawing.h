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

/// Draws markings of image pixels over the picture, into the current window.
class SetDrawing {
public:
    SetDrawing(const PictureFrame& frame, glm::ivec2 image_size) : frame_(frame), size_(image_size) {}

    float unit() const; ///< edge of an image pixel, screen units
    ImVec2 corner(glm::ivec2 pixel) const;
    ImVec2 middle(glm::ivec2 pixel) const;

    void fill(glm::ivec2 pixel, ImU32 colour) const;
    void fill(PixelRect rect, ImU32 colour) const;
    /// Draws the edges of one pixel, inside it.
    void frame(glm::ivec2 pixel, ImU32 colour, float width) const;
    void outline(PixelRect rect, ImU32 colour, float width) const;
    /// Draws a line around the pixels of the set's border, or around the others.
    void outline(const InspectedSet& set, bool border, ImU32 colour, float width) const;
    /// Draws an arrow from one pixel's centre toward another's, over a fraction of the distance.
    void arrow(glm::ivec2 from, glm::ivec2 to, float fraction, ImU32 colour, float width) const;

private:
    const PictureFrame& frame_;
    glm::ivec2 size_;
};

namespace set_colours {
inline constexpr ImU32 inner = IM_COL32(64, 196, 178, 255), border = IM_COL32(255, 168, 51, 255);
}

/// Draws lines and points of the scene, projected by a camera, into the current window.
class SceneLines {
public:
    /// @param size        pixels of the camera's picture, which the frame places
    /// @param least_depth smallest depth that is drawn, scene units
    /// @param lens        point of the lens, in lens radii
    SceneLines(const PictureFrame& frame, const Camera& camera, glm::ivec2 size, float least_depth,
               glm::vec2 lens = glm::vec2(0));

    void line(glm::vec3 from, glm::vec3 to, ImU32 colour, float width) const;
    /// Draws a line with dark edges, which is visible on bright pictures, too.
    void outlined_line(glm::vec3 from, glm::vec3 to, ImU32 colour, float width) const;
    void point(glm::vec3 p, ImU32 colour, float radius) const;
    /// Draws a small square without an edge, for thousands of points.
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

/// Returns the colour of a shift's outcome; grey if it was not tried.
ImU32 outcome_colour(const InspectedShift& shift);

/// Draws offset paths in the colours of their outcomes; the more radiance one has, the more opaque it is.
/// @param marked  index of the highlighted shift; -1: none
void draw_shifts(const SceneLines& lines, const std::vector<const InspectedShift*>& shifts, int marked);

/// Draws a base path in white with its vertices' names, its light samples in yellow, and its footprints in violet.
/// @param far  drawn length of an edge to infinity, scene units
void draw_base_path(const SceneLines& lines, const std::vector<InspectedVertex>& path, float far);

} // namespace tessera
