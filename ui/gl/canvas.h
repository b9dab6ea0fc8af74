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
    false_colour,      ///< the first channel, over a range: false_colours
    direction,         ///< from -1 to 1 in each channel: black to full
    own,               ///< display colours of the image's own
};

/// Whether an image in such colours holds one number a pixel, not three.
inline bool has_one_number(ColourMap map) {
    return map == ColourMap::false_colour || map == ColourMap::own;
}

/// How an image is to lie in a pane.
struct CanvasView {
    glm::ivec2 pane_size{0};   ///< pixels of the framebuffer
    glm::vec2 image_origin{0}; ///< top left corner of the image, pixels from the pane's top left
    glm::vec2 image_extent{0}; ///< size of the image in the pane, pixels
    ColourMap colour_map = ColourMap::radiance;
    Tone tone{};
    ValueRange range{};         ///< of false colours
    bool coarse = false;        ///< interpolate between the display colours of the image's pixels
    bool mark_negative = false; ///< radiance below zero, in any channel

    bool operator==(const CanvasView&) const = default;
};

/// A float image on the graphics side.
class ImageTexture {
public:
    /// Takes over a copy of the pixels, reduced where textures cannot be as large (GlTexture::upload). An empty
    /// image leaves nothing to show.
    void show(const RgbImage& image, int most_edge = std::numeric_limits<int>::max());

    bool empty() const { return !has_image_; }
    int serial() const { return serial_; } ///< changes with every show()
    const GlTexture& texture() const;      ///< without a name if empty

private:
    GlTexture texture_;
    bool has_image_ = false;
    int serial_ = 0;
};

/// The programs that all canvases draw with, one for each kind of view, made when it is first drawn: software
/// renderers go through all branches of a shader at every pixel.
class CanvasShader {
public:
    /// Fills the framebuffer drawn into with the background.
    static void clear();

    /// Draws `image` over it, less `subtrahend` if there is one (of any size; it is stretched), as one that is not
    /// coarse.
    void draw(const GlTexture& image, const CanvasView& view, const GlTexture* subtrahend = nullptr) const;

private:
    /// What the pane's pixels are made of: the image's pixel that each lies in, or all those that it covers.
    enum class Sampling { nearest, averaged };
    /// What a program is made for; all else are numbers that it is given.
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

/// The rendition of an image on the screen, made anew only when image or view change. NaN shows as magenta,
/// infinity as cyan, what is negative (if it is to be marked) as blue.
class Canvas {
public:
    /// The texture that holds the rendition of the image, or of its difference to another (nothing, where either
    /// is empty), bottom row first; 0 for a pane without area.
    GLuint draw(const CanvasShader& shader, const ImageTexture& image, const CanvasView& view,
                const ImageTexture* subtrahend = nullptr);

    int drawings() const { return drawings_; } ///< how often it was drawn: tells whether one was saved
    const Framebuffer& framebuffer() const { return framebuffer_; }

private:
    /// What a rendition was made of.
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
    Framebuffer coarse_;         // of a coarse image's size
    std::optional<Drawn> drawn_; // what the framebuffer holds
    int drawings_ = 0;
};

} // namespace tessera
