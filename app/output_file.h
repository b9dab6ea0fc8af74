#pragma once

#include "render/load/temporary_file.h"

#include <filesystem>

namespace tessera {

/// Makes the folder and those that it lies in, where there are none. Throws BadInput.
void make_folder(const std::filesystem::path& folder);

} // namespace tessera
