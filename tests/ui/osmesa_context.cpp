#include "tests/ui/osmesa_context.h"

#include <stdexcept>

#include <glad/gl.h>

// Declared here because <GL/osmesa.h> includes <GL/gl.h>, which conflicts with glad.
extern "C" {
void* OSMesaCreateContextAttribs(const int* attributes, void* shared);
unsigned char OSMesaMakeCurrent(void* context, void* buffer, unsigned type, int width, int height);
void OSMesaDestroyContext(void* context);
GLADapiproc OSMesaGetProcAddress(const char* name);
}

namespace tessera::test {

namespace {
constexpr int osmesa_format = 0x22, osmesa_profile = 0x33, osmesa_core_profile = 0x34;
constexpr int osmesa_major = 0x36, osmesa_minor = 0x37;
} // namespace

OsmesaContext::OsmesaContext(glm::ivec2 size) {
    const int attributes[] = {
        osmesa_format, GL_RGBA, osmesa_profile, osmesa_core_profile, osmesa_major, 3, osmesa_minor, 3, 0};
    context_ = OSMesaCreateContextAttribs(attributes, nullptr);
    if (context_ == nullptr)
        throw std::runtime_error("OSMesa does not support OpenGL 3.3");
    resize(size);
    if (gladLoadGL(OSMesaGetProcAddress) == 0)
        throw std::runtime_error("OpenGL cannot be loaded");
}

OsmesaContext::~OsmesaContext() {
    OSMesaDestroyContext(context_);
}

void OsmesaContext::resize(glm::ivec2 size) {
    size_ = size;
    pixels_.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4, 0);
    if (!OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, size.x, size.y))
        throw std::runtime_error("OSMesa cannot draw into memory of this size");
}

} // namespace tessera::test
