#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace tessera {

/// The first of "STEM" + ending, "STEM-2" + ending, "STEM-3" + ending ... that is not there, and not taken either.
/// @param is_taken  may be empty
std::filesystem::path free_name(const std::filesystem::path& stem, const std::string& ending = "",
                                const std::function<bool(const std::filesystem::path&)>& is_taken = {});

/// A file in the current folder that is named after what it is and the time: "tessera-20260131-120000.png", or
/// "tessera-20260131-120000-2.png" if that is there, or this process has got the name before, though it may not
/// have written to it yet. To be called from one thread.
/// @param ending  "-charts.csv", ".png"
std::filesystem::path dated_file(const std::string& ending);

} // namespace tessera
