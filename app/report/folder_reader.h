#pragma once

#include "ui/jobs/followed_folder.h"

#include <filesystem>

namespace tessera {

/// What reads the folder that `tessera bench`, `sweep` or `stability` works in, on whichever machine: its list of
/// jobs, which of them are claimed by whom or done, and charts of what is done, as the reports have them. Claims
/// nothing and changes nothing. Throws std::runtime_error that says what of the folder is missing.
FolderReader folder_reader(const std::filesystem::path& folder);

} // namespace tessera
