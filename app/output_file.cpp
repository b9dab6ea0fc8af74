#include "app/output_file.h"

#include "app/exit_codes.h"
#include "render/load/temporary_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/core.h>

namespace tessera {

void check_writable(const std::filesystem::path& path) {
    if (std::filesystem::is_directory(path))
        throw BadInput(fmt::format("{}: is a folder, not a file to write to", path.string()));
    // Trying is the only test that holds for root, full disks and odd file systems alike.
    const std::filesystem::path trial = path.string() + ".part";
    const bool made = static_cast<bool>(std::ofstream(trial, std::ios::binary));
    const std::string reason = std::strerror(errno);
    if (!made)
        throw BadInput(fmt::format("{}: cannot be written: {}", path.string(), reason));
    std::filesystem::remove(trial);
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
        throw BadInput(fmt::format("{}: the folder cannot be made: {}", folder.string(),
                                   error ? error.message() : "a file is in its place"));
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    TemporaryFile temporary(path);
    std::ofstream out(temporary.path(), std::ios::binary);
    out << text;
    out.close();
    if (!out)
        throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
    temporary.commit();
}

} // namespace tessera
