#pragma once

#include "ui/viewer.h"

namespace tessera {

/// Writes the same EXR file as `tessera render --buffers`, with the camera, the norm, the times and what was
/// counted in its header. Throws std::exception that names the file.
void write_saved_picture(const std::filesystem::path& file, const SavedPicture& picture);

} // namespace tessera
