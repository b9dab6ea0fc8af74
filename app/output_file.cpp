#include "app/output_file.h"

#include "app/exit_codes.h"

#include <fstream>

#include <fmt/core.h>

namespace tessera {

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
