#include "render/load/mesh_files.h"

#include <fstream>
#include <stdexcept>

namespace tessera {

std::string read_bytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    if (!stream)
        throw std::runtime_error("the file cannot be opened");
    const std::streamoff size = stream.tellg();
    if (size < 0)
        throw std::runtime_error("the file cannot be read");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    stream.seekg(0);
    if (!stream.read(bytes.data(), size))
        throw std::runtime_error("the file cannot be read");
    return bytes;
}

Mesh read_obj(const std::filesystem::path& file) {
    return parse_obj(read_bytes(file));
}

Mesh read_ply(const std::filesystem::path& file) {
    return parse_ply(read_bytes(file));
}

} // namespace tessera
