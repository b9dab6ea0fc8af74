#pragma once

#include "render/load/temporary_file.h"

#include <filesystem>
#include <string>

namespace tessera {

/// Makes the folder and those that it lies in, where there are none. Throws BadInput.
void make_folder(const std::filesystem::path& folder);

/// Writes to a temporary name beside `path` and renames it. Throws std::runtime_error that names the file.
void write_text(const std::filesystem::path& path, const std::string& text);

} // namespace tessera
