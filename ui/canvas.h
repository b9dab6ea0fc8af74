#pragma once

#include "ui/gl.h"

#include <optional>

namespace tessera {

enum class ColourMap {
    radiance,          ///< exposure, then sRGB
    signed_difference, ///< luminance, exposed: orange above zero, blue below
    false_colour,      ///< the first channel, from 0 to a top value: false_colours
};

/// How an image is to lie in a pane.
struct CanvasView {
    glm::ivec2 pane_size{0};   ///< pixels of the framebuffer
    glm::vec2 image_origin{0}; ///< top left corner of the image, pixels from the pane's top left
    glm::vec2 image_extent{0}; ///< size of the image in the pane, pixels
    ColourMap colour_map = ColourMap::radiance;
    float exposure = 0;  ///< stops
    bool coarse = false; ///< interpolate between the image's pixels
    float top = 1;       ///< of false colours: the value that the last of them stands for

    bool operator==(const CanvasView&) const = default;
};

/// The program that all canvases draw with.
class CanvasShader {
public:
    CanvasShader();
    /// Fills the framebuffer drawn into. Without an image, with the background.
    void draw(const GlTexture& image, const CanvasView& view) const;

private:
    Program program_;
    EmptyVertexArray vertices_;
};

/// One pane's picture: a float image and its rendition on the screen, made anew only when one of them changes.
/// NaN shows as magenta, infinity as cyan.
class Canvas {
public:
    /// Takes over the pixels of a copy on the graphics side. An empty image leaves the background alone.
    void show(const RgbImage& image);

    /// The texture that holds the rendition, bottom row first; 0 for a pane without area.
    GLuint draw(const CanvasShader& shader, const CanvasView& view);

    bool empty() const { return !has_image_; }
    int drawings() const { return drawings_; } ///< how often it was drawn: tells whether one was saved

    const Framebuffer& framebuffer() const { return framebuffer_; }

private:
    GlTexture image_;
    Framebuffer framebuffer_;
    std::optional<CanvasView> drawn_; // what the framebuffer holds
    bool has_image_ = false;
    int drawings_ = 0;
};

} // namespace tessera
