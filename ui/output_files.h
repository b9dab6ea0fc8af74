#pragma once

#include <filesystem>
#include <string>

namespace tessera {

/// A file in the current folder that is named after what it is and the time: "tessera-20260131-120000.png".
/// @param ending  "-charts.csv", ".png"
std::filesystem::path dated_file(const std::string& ending);

/// Writes such a file; returns its name.
std::string write_dated(const std::string& ending, const std::string& text);

/// Writes to a temporary name beside `path` and renames it. Throws std::runtime_error that names the file.
void write_text_file(const std::filesystem::path& path, const std::string& text);

} // namespace tessera
