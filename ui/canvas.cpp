#include "ui/canvas.h"

#include "embedded/canvas_fragment_shader.h"
#include "embedded/canvas_vertex_shader.h"
#include "ui/false_colours.h"

#include <cmath>

namespace tessera {

namespace {
constexpr glm::vec3 background_colour(0.055f, 0.058f, 0.066f);
} // namespace

CanvasShader::CanvasShader() : program_(canvas_vertex_shader, canvas_fragment_shader) {}

const GlTexture& ImageTexture::texture() const {
    static const GlTexture none;
    return has_image_ ? texture_ : none;
}

void ImageTexture::show(const RgbImage& image) {
    has_image_ = !image.empty();
    if (has_image_)
        texture_.upload(image);
    ++serial_;
}

void CanvasShader::draw(const GlTexture& image, const CanvasView& view, const GlTexture* subtrahend) const {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glClearColor(background_colour.r, background_colour.g, background_colour.b, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    if (image.name() == 0 || view.image_extent.x <= 0 || view.image_extent.y <= 0)
        return;
    program_.use();
    program_.set("image", 0);
    program_.set("pane_size", view.pane_size);
    program_.set("image_origin", view.image_origin);
    program_.set("image_extent", view.image_extent);
    program_.set("gain", std::exp2(view.tone.exposure));
    program_.set("tone_curve", static_cast<int>(view.tone.curve));
    program_.set("gamma", view.tone.gamma);
    program_.set("range", glm::vec2(view.range.low, view.range.high));
    program_.set("is_logarithmic", view.range.logarithmic ? 1 : 0);
    program_.set("marks_negative", view.mark_negative ? 1 : 0);
    program_.set("subtrahend", 1);
    program_.set("is_difference", subtrahend != nullptr ? 1 : 0);
    program_.set("colour_map", static_cast<int>(view.colour_map));
    program_.set("false_colours", false_colours);
    program_.set("is_coarse", view.coarse ? 1 : 0);
    program_.set("background", background_colour);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, subtrahend != nullptr ? subtrahend->name() : 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, image.name());
    vertices_.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glUseProgram(0);
}

GLuint Canvas::draw(const CanvasShader& shader, const ImageTexture& image, const CanvasView& view,
                    const ImageTexture* subtrahend) {
    if (view.pane_size.x < 1 || view.pane_size.y < 1)
        return 0;
    const Drawn wanted{view, &image, subtrahend, image.serial(), subtrahend ? subtrahend->serial() : 0};
    if (drawn_ == wanted)
        return framebuffer_.colour().name();
    framebuffer_.resize(view.pane_size);
    const DrawInto target(framebuffer_);
    static const GlTexture none;
    const bool lacks_one = subtrahend && subtrahend->empty(); // and so there is no difference
    shader.draw(lacks_one ? none : image.texture(), view, subtrahend ? &subtrahend->texture() : nullptr);
    drawn_ = wanted;
    ++drawings_;
    return framebuffer_.colour().name();
}

} // namespace tessera
