#include "ui/canvas.h"

#include "embedded/canvas_fragment_shader.h"
#include "embedded/canvas_vertex_shader.h"
#include "ui/false_colours.h"

#include <cmath>

#include <fmt/core.h>
#include <glm/vector_relational.hpp>

namespace tessera {

namespace {
constexpr glm::vec3 background_colour(0.055f, 0.058f, 0.066f);
} // namespace

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

CanvasShader::Sampling CanvasShader::sampling_of(glm::ivec2 image_size, const CanvasView& view) {
    if (view.coarse)
        return Sampling::interpolated;
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

void CanvasShader::draw(const GlTexture& image, const CanvasView& view, const GlTexture* subtrahend) const {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glClearColor(background_colour.r, background_colour.g, background_colour.b, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    if (image.name() == 0 || view.image_extent.x <= 0 || view.image_extent.y <= 0)
        return;
    const Program& program = program_of({view.colour_map, sampling_of(image.size(), view), subtrahend != nullptr});
    program.use();
    program.set("image", 0);
    program.set("pane_size", view.pane_size);
    program.set("image_origin", view.image_origin);
    program.set("image_extent", view.image_extent);
    program.set("gain", std::exp2(view.tone.exposure));
    program.set("tone_curve", static_cast<int>(view.tone.curve));
    program.set("gamma", view.tone.gamma);
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
