#include "ui/gl/gl.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include <glad/gl.h>

namespace tessera {

// --- GlTexture ---

GlTexture::~GlTexture() {
    if (name_ != 0)
        glDeleteTextures(1, &name_);
}

GlTexture::GlTexture(GlTexture&& other) noexcept
    : name_(std::exchange(other.name_, 0)), size_(std::exchange(other.size_, glm::ivec2(0))) {}

GlTexture& GlTexture::operator=(GlTexture&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(size_, other.size_);
    return *this;
}

void GlTexture::bind() {
    if (name_ != 0) {
        glBindTexture(GL_TEXTURE_2D, name_);
        return;
    }
    glGenTextures(1, &name_);
    glBindTexture(GL_TEXTURE_2D, name_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

namespace {

/// Returns whether the driver can allocate a float texture of that size.
bool has_textures_of(glm::ivec2 size) {
    glTexImage2D(GL_PROXY_TEXTURE_2D, 0, GL_RGB32F, size.x, size.y, 0, GL_RGB, GL_FLOAT, nullptr);
    GLint width = 0;
    glGetTexLevelParameteriv(GL_PROXY_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
    return width == size.x;
}

glm::ivec2 reduced_size(const RgbImage& image, int step) {
    return (glm::ivec2(image.width(), image.height()) + step - 1) / step;
}

/// Returns the means over squares of step x step pixels, in which NaN and infinity stay visible.
RgbImage reduced(const RgbImage& image, int step) {
    const glm::ivec2 size = reduced_size(image, step);
    RgbImage result(size.x, size.y);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const int x1 = std::min((x + 1) * step, image.width()), y1 = std::min((y + 1) * step, image.height());
            Rgb sum(0);
            for (int from_y = y * step; from_y < y1; ++from_y)
                for (int from_x = x * step; from_x < x1; ++from_x)
                    sum += image(from_x, from_y);
            result(x, y) = sum / static_cast<float>((x1 - x * step) * (y1 - y * step));
        }
    return result;
}

} // namespace

void GlTexture::upload(const RgbImage& image, int most_edge) {
    bind();
    glm::ivec2 size = reduced_size(image, 1);
    int step = 1;
    const auto fits = [&] {
        return std::max(size.x, size.y) <= most_edge && (size == size_ || has_textures_of(size));
    };
    while (!fits() && size != glm::ivec2(1))
        size = reduced_size(image, ++step);
    const RgbImage smaller = step > 1 ? reduced(image, step) : RgbImage();
    const Rgb* const pixels = step > 1 ? smaller.data() : image.data();
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    if (size == size_)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_RGB, GL_FLOAT, pixels);
    else
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, size.x, size.y, 0, GL_RGB, GL_FLOAT, pixels);
    size_ = size;
}

void GlTexture::allocate_rgba8(glm::ivec2 size) {
    bind();
    // The texture is shown pixel by pixel, and software renderers are faster without a filter.
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.x, size.y, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    size_ = size;
}

// --- Framebuffer ---

Framebuffer::~Framebuffer() {
    if (name_ != 0)
        glDeleteFramebuffers(1, &name_);
}

Framebuffer::Framebuffer(Framebuffer&& other) noexcept
    : name_(std::exchange(other.name_, 0)), colour_(std::move(other.colour_)) {}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
    std::swap(name_, other.name_);
    colour_ = std::move(other.colour_);
    return *this;
}

void Framebuffer::resize(glm::ivec2 size) {
    if (size == colour_.size())
        return;
    colour_.allocate_rgba8(size);
    if (name_ != 0)
        return;
    GLint previous = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &previous);
    glGenFramebuffers(1, &name_);
    glBindFramebuffer(GL_FRAMEBUFFER, name_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.name(), 0);
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(previous));
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OpenGL cannot draw into a texture of " + std::to_string(size.x) + "x" +
                                 std::to_string(size.y) + " pixels");
}

DrawInto::DrawInto(const Framebuffer& target) {
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &previous_);
    glGetIntegerv(GL_VIEWPORT, viewport_);
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glViewport(0, 0, target.size().x, target.size().y);
}

DrawInto::~DrawInto() {
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(previous_));
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
}

// --- Program ---

namespace {

std::string shader_log(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    glGetShaderInfoLog(shader, length, nullptr, log.data());
    return log;
}

GLuint compile(GLenum kind, std::string_view source) {
    const GLuint shader = glCreateShader(kind);
    const char* text = source.data();
    const GLint length = static_cast<GLint>(source.size());
    glShaderSource(shader, 1, &text, &length);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok != 0)
        return shader;
    const std::string log = shader_log(shader);
    glDeleteShader(shader);
    throw std::runtime_error("A shader does not compile: " + log);
}

} // namespace

Program::Program(std::string_view vertex, std::string_view fragment) {
    const GLuint shaders[] = {compile(GL_VERTEX_SHADER, vertex), compile(GL_FRAGMENT_SHADER, fragment)};
    name_ = glCreateProgram();
    for (GLuint shader : shaders) {
        glAttachShader(name_, shader);
        glDeleteShader(shader); // freed with the program
    }
    glLinkProgram(name_);
    GLint ok = 0;
    glGetProgramiv(name_, GL_LINK_STATUS, &ok);
    if (ok == 0) {
        glDeleteProgram(name_);
        throw std::runtime_error("A shader program does not link");
    }
}

Program::~Program() {
    glDeleteProgram(name_);
}

ScreenPixels read_screen(glm::ivec2 size) {
    ScreenPixels pixels{size, {}};
    const std::size_t stride = 3 * static_cast<std::size_t>(size.x);
    pixels.rgb.resize(stride * static_cast<std::size_t>(size.y));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, pixels.rgb.data());
    // OpenGL's first row is the lowest.
    for (std::size_t top = 0, bottom = static_cast<std::size_t>(size.y); top + 1 < bottom; ++top) {
        --bottom;
        std::swap_ranges(pixels.rgb.begin() + static_cast<std::ptrdiff_t>(top * stride),
                         pixels.rgb.begin() + static_cast<std::ptrdiff_t>((top + 1) * stride),
                         pixels.rgb.begin() + static_cast<std::ptrdiff_t>(bottom * stride));
    }
    return pixels;
}

} // namespace tessera
