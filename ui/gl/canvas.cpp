#include "ui/gl/canvas.h"

#include "embedded/canvas_fragment_shader.h"
#include "embedded/canvas_vertex_shader.h"
#include "ui/gl/tone.h"

#include <cmath>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace tessera {

namespace {
constexpr glm::vec3 background_colour(0.055f, 0.058f, 0.066f);

/// Limits drawing to the image, since software renderers run the shader for every pixel drawn. The shader decides
/// exactly, within a pixel of the image's border.
void clip_to_image(const CanvasView& view) {
    const glm::vec2 pane(view.pane_size);
    const glm::ivec2 min(glm::clamp(glm::floor(view.image_origin), glm::vec2(0), pane)),
        max(glm::clamp(glm::ceil(view.image_origin + view.image_extent), glm::vec2(0), pane));
    glScissor(min.x, view.pane_size.y - max.y, max.x - min.x, max.y - min.y); // y counts from the bottom
}
} // namespace

const GlTexture& ImageTexture::texture() const {
    static const GlTexture none;
    return has_image_ ? texture_ : none;
}

void ImageTexture::show(const RgbImage& image, int most_edge) {
    has_image_ = !image.empty();
    if (has_image_)
        texture_.upload(image, most_edge);
    ++serial_;
}

CanvasShader::Sampling CanvasShader::sampling_of(glm::ivec2 image_size, const CanvasView& view) {
    const bool is_shrunk = glm::any(glm::greaterThan(glm::vec2(image_size), view.image_extent));
    return is_shrunk ? Sampling::averaged : Sampling::nearest;
}

std::string CanvasShader::fragment_shader_of(const Kind& kind) {
    return fmt::format("#version 330 core\n"
                       "const int colour_map = {};\n"
                       "const int sampling = {};\n"
                       "const bool is_difference = {};\n"
                       "{}",
                       static_cast<int>(kind.colour_map), static_cast<int>(kind.sampling), kind.is_difference,
                       canvas_fragment_shader);
}

const Program& CanvasShader::program_of(const Kind& kind) const {
    std::unique_ptr<const Program>& program = programs_[kind];
    if (!program)
        program = std::make_unique<Program>(canvas_vertex_shader, fragment_shader_of(kind));
    return *program;
}

void CanvasShader::clear() {
    glDisable(GL_SCISSOR_TEST);
    glClearColor(background_colour.r, background_colour.g, background_colour.b, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
}

void CanvasShader::draw(const GlTexture& image, const CanvasView& view, const GlTexture* subtrahend) const {
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    const Program& program = program_of({view.colour_map, sampling_of(image.size(), view), subtrahend != nullptr});
    program.use();
    program.set("image", 0);
    program.set("pane_size", view.pane_size);
    program.set("image_origin", view.image_origin);
    program.set("image_extent", view.image_extent);
    program.set("gain", std::exp2(view.tone.exposure));
    program.set("tone_curve", static_cast<int>(view.tone.curve));
    program.set("range", glm::vec2(view.range.low, view.range.high));
    program.set("is_logarithmic", view.range.logarithmic ? 1 : 0);
    program.set("marks_negative", view.mark_negative ? 1 : 0);
    program.set("subtrahend", 1);
    program.set("false_colours", false_colours);
    program.set("background", background_colour);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, subtrahend != nullptr ? subtrahend->name() : 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, image.name());
    vertices_.bind();
    glEnable(GL_SCISSOR_TEST);
    clip_to_image(view);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
    glBindVertexArray(0);
    glUseProgram(0);
}

/// Draws a coarse image at its own size, and stretches the result. Interpolation in the shader would run it for
/// each pane pixel, which takes software renderers several times as long.
void Canvas::draw_stretched(const CanvasShader& shader, const GlTexture& image, const CanvasView& view,
                            const GlTexture* subtrahend) {
    CanvasView small = view;
    small.pane_size = image.size();
    small.image_origin = glm::vec2(0);
    small.image_extent = image.size();
    coarse_.resize(image.size());
    {
        const DrawInto target(coarse_);
        shader.draw(image, small, subtrahend);
    }
    const glm::ivec2 min(glm::round(view.image_origin)), max(glm::round(view.image_origin + view.image_extent));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, coarse_.name());
    glBlitFramebuffer(0, 0, image.size().x, image.size().y, min.x, view.pane_size.y - max.y, max.x,
                      view.pane_size.y - min.y, GL_COLOR_BUFFER_BIT, GL_LINEAR);
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
    CanvasShader::clear();
    const bool has_area = view.image_extent.x > 0 && view.image_extent.y > 0;
    if (has_area && !image.empty() &&
        !(subtrahend && subtrahend->empty())) { // else only the background is visible
        const GlTexture* const other = subtrahend ? &subtrahend->texture() : nullptr;
        if (view.coarse)
            draw_stretched(shader, image.texture(), view, other);
        else
            shader.draw(image.texture(), view, other);
    }
    drawn_ = wanted;
    ++drawings_;
    return framebuffer_.colour().name();
}

} // namespace tessera
