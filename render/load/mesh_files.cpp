#include "render/load/mesh_files.h"

#include <stdexcept>

namespace tessera {

std::ifstream open_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw std::runtime_error("the file cannot be opened");
    return stream;
}

std::string read_bytes(const std::filesystem::path& file) {
    std::ifstream stream = open_file(file);
    stream.seekg(0, std::ios::end);
    const std::streamoff size = stream.tellg();
    if (size < 0)
        throw std::runtime_error("the file cannot be read");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    stream.seekg(0);
    if (!stream.read(bytes.data(), size))
        throw std::runtime_error("the file cannot be read");
    return bytes;
}

} // namespace tessera
