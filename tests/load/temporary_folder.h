#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <unistd.h>

namespace tessera {

/// Returns a TGA image of one row. `pixels` holds blue, green and red bytes of each pixel.
inline std::string tga_row(const std::string& pixels) {
    std::string header(18, '\0');
    header[2] = 2; // uncompressed true colour
    header[12] = static_cast<char>(pixels.size() / 3);
    header[14] = 1;
    header[16] = 24;
    header[17] = 0x20; // rows from top to bottom
    return header + pixels;
}

/// Temporary folder that the destructor deletes.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "tessera-load-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, std::string_view contents) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << contents;
        return path_ / name;
    }

private:
    std::filesystem::path path_;
};

} // namespace tessera
