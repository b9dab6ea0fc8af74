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

// Owners of OpenGL objects. Each creates its object at first use and deletes it in its destructor: a context must
// be current at both times.

class GlTexture {
public:
    GlTexture() = default;
    ~GlTexture();
    GlTexture(GlTexture&& other) noexcept;
    GlTexture& operator=(GlTexture&& other) noexcept;

    /// Uploads pixels as 32-bit floats. The storage is kept while the size stays. The image must not be empty. If
    /// the driver has no textures of that size, or an edge is longer than `most_edge`, squares of pixels are
    /// replaced by their mean.
    void upload(const RgbImage& image, int most_edge = std::numeric_limits<int>::max());
    /// Allocates storage for 8-bit RGBA with undefined contents. `size` >= 1x1.
    void allocate_rgba8(glm::ivec2 size);

    GLuint name() const { return name_; }     ///< 0 before the first upload
    glm::ivec2 size() const { return size_; } ///< of the texture, which may be smaller than the image

private:
    void bind();
    GLuint name_ = 0;
    glm::ivec2 size_{0};
};

/// Framebuffer with an 8-bit colour texture.
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

/// Binds a framebuffer with its whole viewport for the lifetime of this object, then restores the previous one.
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

/// Linked vertex and fragment shader. The constructor throws std::runtime_error with the compiler's log.
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

/// Vertex array without arrays, for a shader that makes its own vertices.
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

/// Pixels in 8-bit RGB, row by row from the top left.
struct ScreenPixels {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgb;

    const std::uint8_t* at(int x, int y) const {
        return rgb.data() +
               3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x));
    }
};

/// Reads the framebuffer bound for reading, from its lower left corner.
ScreenPixels read_screen(glm::ivec2 size);

} // namespace tessera
