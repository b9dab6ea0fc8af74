#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

/// Returns the file of a frame: the digits of its number replace the last "####" of the name, at least as many
/// digits as there are signs; a name without "#" gets "-0007" in front of its extension.
std::filesystem::path frame_name(const std::filesystem::path& output, int number);

/// Returns a file for each scene: "-SCENE" in front of the extension, and "-SCENE-2" for a second scene of that
/// name. One scene keeps the name.
std::vector<std::filesystem::path> scene_outputs(const std::filesystem::path& output,
                                                 const std::vector<std::string>& scenes);

} // namespace tessera
