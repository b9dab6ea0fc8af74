#pragma once

#include "ui/gl/gl.h"
#include "ui/gl/tone.h"

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace tessera {

enum class ColourMap {
    radiance,          ///< exposure, then the tone curve
    signed_difference, ///< luminance, exposed: orange above zero, blue below
    false_colour,      ///< first channel over a range, in false_colours
    direction,         ///< -1 to 1 in each channel, from black to full
    own,               ///< display colours, shown unchanged
};

/// Returns whether an image in such colours holds one number a pixel, not three.
inline bool has_one_number(ColourMap map) {
    return map == ColourMap::false_colour || map == ColourMap::own;
}

/// Placement and appearance of an image in a pane.
struct CanvasView {
    glm::ivec2 pane_size{0};   ///< pixels of the framebuffer
    glm::vec2 image_origin{0}; ///< top left corner of the image, pixels from the pane's top left
    glm::vec2 image_extent{0}; ///< size of the image in the pane, pixels
    ColourMap colour_map = ColourMap::radiance;
    Tone tone{};
    ValueRange range{};         ///< values of the false colours
    bool coarse = false;        ///< interpolate between the display colours of the image's pixels
    bool mark_negative = false; ///< marks radiance below zero in any channel

    bool operator==(const CanvasView&) const = default;
};

/// A float image as a texture.
class ImageTexture {
public:
    /// Uploads the pixels, reduced if textures cannot be as large (GlTexture::upload). An empty image removes the
    /// texture.
    void show(const RgbImage& image, int most_edge = std::numeric_limits<int>::max());

    bool empty() const { return !has_image_; }
    int serial() const { return serial_; } ///< changes with every show()
    const GlTexture& texture() const;      ///< name 0 if empty

private:
    GlTexture texture_;
    bool has_image_ = false;
    int serial_ = 0;
};

/// Shader programs of all canvases, one for each kind of view, compiled when it is first drawn. Separate programs
/// avoid branches, all of which software renderers evaluate at every pixel.
class CanvasShader {
public:
    /// Fills the bound framebuffer with the background.
    static void clear();

    /// Draws `image` over it, minus `subtrahend` if there is one (of any size; it is stretched). Ignores
    /// CanvasView::coarse.
    void draw(const GlTexture& image, const CanvasView& view, const GlTexture* subtrahend = nullptr) const;

private:
    /// Sampling of the image by pane pixels: the nearest image pixel, or the mean over the covered ones.
    enum class Sampling { nearest, averaged };
    /// Properties compiled into a program; everything else is a uniform.
    struct Kind {
        ColourMap colour_map;
        Sampling sampling;
        bool is_difference;
        auto operator<=>(const Kind&) const = default;
    };
    static Sampling sampling_of(glm::ivec2 image_size, const CanvasView& view);
    static std::string fragment_shader_of(const Kind& kind);
    const Program& program_of(const Kind& kind) const;

    mutable std::map<Kind, std::unique_ptr<const Program>> programs_;
    EmptyVertexArray vertices_;
};

/// Rendition of an image on the screen, redrawn only when image or view change. NaN is magenta, infinity cyan, and
/// negative values, if marked, blue.
class Canvas {
public:
    /// Returns the texture with the rendition of the image, or of its difference to another, bottom row first. If
    /// an image is empty, it shows the background. Returns 0 for a pane without area.
    GLuint draw(const CanvasShader& shader, const ImageTexture& image, const CanvasView& view,
                const ImageTexture* subtrahend = nullptr);

    int drawings() const { return drawings_; } ///< number of times it was redrawn
    const Framebuffer& framebuffer() const { return framebuffer_; }

private:
    /// Inputs of a rendition.
    struct Drawn {
        CanvasView view;
        const ImageTexture* image;
        const ImageTexture* subtrahend;
        int image_serial;
        int subtrahend_serial;
        bool operator==(const Drawn&) const = default;
    };
    void draw_stretched(const CanvasShader& shader, const GlTexture& image, const CanvasView& view,
                        const GlTexture* subtrahend);

    Framebuffer framebuffer_;
    Framebuffer coarse_;         // at the size of a coarse image
    std::optional<Drawn> drawn_; // inputs of the framebuffer's content
    int drawings_ = 0;
};

} // namespace tessera
