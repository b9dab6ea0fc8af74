#pragma once

#include "render/scene/camera.h"
#include "ui/picture_frame.h"

#include <string>

#include <imgui.h>

namespace tessera {

/// With another opacity, in [0, 1].
ImU32 with_alpha(ImU32 colour, float alpha);

/// Draws lines and points of the scene, as a camera sees them, into the current window.
class SceneLines {
public:
    /// @param size        pixels of the camera's picture, which lies in the frame
    /// @param least_depth what lies nearer is not drawn, units of the scene
    SceneLines(const PictureFrame& frame, const Camera& camera, glm::ivec2 size, float least_depth);

    void line(glm::vec3 from, glm::vec3 to, ImU32 colour, float width) const;
    /// Plain on bright pictures, too.
    void outlined_line(glm::vec3 from, glm::vec3 to, ImU32 colour, float width) const;
    void point(glm::vec3 p, ImU32 colour, float radius) const;
    /// A small square, without an edge: for thousands of them.
    void dot(glm::vec3 p, ImU32 colour, float width) const;
    /// Beside the point.
    void name(glm::vec3 p, const std::string& text, ImU32 colour) const;

private:
    ImVec2 on_screen(glm::vec3 projected) const;

    const PictureFrame& frame_;
    Projection projection_;
    glm::ivec2 size_;
    float least_depth_;
};

} // namespace tessera
