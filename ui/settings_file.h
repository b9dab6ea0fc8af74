#pragma once

#include "ui/viewer_state.h"

#include <filesystem>
#include <string>

namespace tessera {

/// What a user has set, as JSON: the panes with all their settings, camera, size, tone, pace, ranges, where the
/// pictures lie, what the path inspector and the slow motion show (inspection_settings.h), and where the view in
/// space looks.
std::string settings_json(const ViewerState& state);

/// Sets what such a text holds; what it does not mention stays. A camera file (render/load/camera_file.h) sets the
/// camera alone. Throws LoadError with `name`, line and column, and has then changed nothing.
void apply_settings_json(ViewerState& state, const std::string& json, const std::string& name);

/// The same of a file. Throws also where it cannot be read.
void apply_settings_file(ViewerState& state, const std::filesystem::path& file);

} // namespace tessera
