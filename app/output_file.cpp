#include "app/output_file.h"

#include "app/exit_codes.h"

#include <fmt/core.h>

namespace tessera {

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
        throw BadInput(fmt::format("{}: the folder cannot be made: {}", folder.string(),
                                   error ? error.message() : "a file is in its place"));
}

} // namespace tessera
