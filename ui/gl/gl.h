#pragma once

#include "recon/image.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include <glad/gl.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Owners of OpenGL objects. Each makes its object at the first use and frees it at its end: a context must be
/// current at both.

class GlTexture {
public:
    GlTexture() = default;
    ~GlTexture();
    GlTexture(GlTexture&& other) noexcept;
    GlTexture& operator=(GlTexture&& other) noexcept;

    /// Pixels as 32-bit floats; the storage is kept while the size stays. Not for an empty image. Where the driver
    /// has no textures of that size, or an edge is longer than `most_edge`, squares of pixels become one, their
    /// mean.
    void upload(const RgbImage& image, int most_edge = std::numeric_limits<int>::max());
    /// Storage for 8-bit RGBA, contents undefined. `size` >= 1x1.
    void allocate_rgba8(glm::ivec2 size);

    GLuint name() const { return name_; }     ///< 0 before the first upload
    glm::ivec2 size() const { return size_; } ///< of the texture, whatever that of the image

private:
    void bind();
    GLuint name_ = 0;
    glm::ivec2 size_{0};
};

/// Something to draw into: an 8-bit colour texture.
class Framebuffer {
public:
    Framebuffer() = default;
    ~Framebuffer();
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&& other) noexcept;

    void resize(glm::ivec2 size); ///< >= 1x1; contents are lost if it differs
    glm::ivec2 size() const { return colour_.size(); }
    const GlTexture& colour() const { return colour_; }
    GLuint name() const { return name_; }

private:
    GLuint name_ = 0;
    GlTexture colour_;
};

/// Drawing goes to the framebuffer, over its whole size, while this lives; then to where it went before.
class DrawInto {
public:
    explicit DrawInto(const Framebuffer& target);
    ~DrawInto();
    DrawInto(const DrawInto&) = delete;
    DrawInto& operator=(const DrawInto&) = delete;

private:
    GLint previous_ = 0;
    GLint viewport_[4] = {};
};

/// A linked vertex and fragment shader. Throws std::runtime_error with the compiler's log.
class Program {
public:
    Program(std::string_view vertex, std::string_view fragment);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void use() const { glUseProgram(name_); }

    /// Set a uniform of the program in use.
    void set(const char* uniform, int value) const { glUniform1i(location(uniform), value); }
    void set(const char* uniform, float value) const { glUniform1f(location(uniform), value); }
    void set(const char* uniform, glm::ivec2 v) const { glUniform2i(location(uniform), v.x, v.y); }
    void set(const char* uniform, glm::vec2 v) const { glUniform2f(location(uniform), v.x, v.y); }
    void set(const char* uniform, glm::vec3 v) const { glUniform3f(location(uniform), v.x, v.y, v.z); }
    void set(const char* uniform, std::span<const glm::vec3> array) const {
        glUniform3fv(location(uniform), static_cast<GLsizei>(array.size()), &array.front().x);
    }

private:
    GLint location(const char* uniform) const { return glGetUniformLocation(name_, uniform); }
    GLuint name_ = 0;
};

/// Vertex array without arrays: what a shader that makes its own vertices is drawn with.
class EmptyVertexArray {
public:
    EmptyVertexArray() { glGenVertexArrays(1, &name_); }
    ~EmptyVertexArray() { glDeleteVertexArrays(1, &name_); }
    EmptyVertexArray(const EmptyVertexArray&) = delete;
    EmptyVertexArray& operator=(const EmptyVertexArray&) = delete;

    void bind() const { glBindVertexArray(name_); }

private:
    GLuint name_ = 0;
};

/// 8-bit RGB, row by row from the top left.
struct ScreenPixels {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgb;

    const std::uint8_t* at(int x, int y) const {
        return rgb.data() +
               3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x));
    }
};

/// What was drawn into the framebuffer bound for reading, from its lower left corner.
ScreenPixels read_screen(glm::ivec2 size);

} // namespace tessera
