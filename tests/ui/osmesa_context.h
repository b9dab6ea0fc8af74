#pragma once

#include <vector>

#include <glm/vec2.hpp>

namespace tessera::test {

/// An OpenGL 3.3 context with a framebuffer of `size` pixels in memory. It is current in the calling thread.
class OsmesaContext {
public:
    explicit OsmesaContext(glm::ivec2 size);
    ~OsmesaContext();
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;

    void resize(glm::ivec2 size);
    glm::ivec2 size() const { return size_; }

private:
    void* context_ = nullptr;
    glm::ivec2 size_;
    std::vector<unsigned char> pixels_;
};

} // namespace tessera::test
