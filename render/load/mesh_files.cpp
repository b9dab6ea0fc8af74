#include "render/load/mesh_files.h"

#include <stdexcept>
#include <system_error>

namespace tessera {

std::ifstream open_file(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) // opens as a file does, and is then of endless size
        throw std::runtime_error("it is a folder, not a file");
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
