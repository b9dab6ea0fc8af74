#include "ui/screenshot.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include <glad/gl.h>
#include <stb_image_write.h>
#include <unistd.h>

namespace tessera {

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

void write_png(const std::filesystem::path& path, const ScreenPixels& pixels) {
    const std::string temporary = path.string() + ".part" + std::to_string(getpid());
    std::ofstream file(temporary, std::ios::binary);
    const auto write = [](void* context, void* data, int bytes) {
        static_cast<std::ofstream*>(context)->write(static_cast<const char*>(data), bytes);
    };
    const bool encoded = file && stbi_write_png_to_func(write, &file, pixels.size.x, pixels.size.y, 3,
                                                        pixels.rgb.data(), 3 * pixels.size.x) != 0;
    file.close();
    std::error_code error;
    if (encoded && !file.fail())
        std::filesystem::rename(temporary, path, error);
    if (encoded && !file.fail() && !error)
        return;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error(path.string() + ": cannot be written" + (error ? ": " + error.message() : ""));
}

} // namespace tessera
