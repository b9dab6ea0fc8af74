#pragma once

#include "ui/viewer.h"

namespace tessera {

/// Writes the same EXR file as `tessera render --buffers`, with the camera, the norm, the times and what was
/// counted in its header, and layers for what else the viewer shows: albedo, normal and depth, and errors to a
/// reference of the picture's size. The reconstruction is the snapshot's own if that is of its newest pass and
/// made with these settings; otherwise it is made now. Throws std::exception that names the file.
void write_saved_picture(const std::filesystem::path& file, const SavedPicture& picture);

} // namespace tessera
