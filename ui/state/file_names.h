#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// Returns the first of "STEM" + ending, "STEM-2" + ending, ... that neither exists nor is taken.
/// @param is_taken  excludes more names; may be empty
std::filesystem::path unused_name(const std::filesystem::path& stem, const std::string& ending = "",
                                  const std::function<bool(const std::filesystem::path&)>& is_taken = {});

/// Returns a new file name with the current time in the folder (empty: the current one):
/// "tessera-20260131-120000.png", or "tessera-20260131-120000-2.png" if that exists or this function has returned
/// it before. Not thread-safe.
/// @param ending  "-charts.csv", ".png"
std::filesystem::path dated_file(const std::string& ending, const std::filesystem::path& folder = {});

struct FileEntry {
    std::string name;
    bool is_folder = false;

    bool operator==(const FileEntry&) const = default;
};

/// Whether the file has the extension (".xml"), ignoring case.
bool has_extension(const std::filesystem::path& file, std::string_view extension);

/// Returns a folder's subfolders, then its files with the extension (".xml", ignoring case), both sorted by name.
/// @param error  set to the reason why the folder cannot be read, or to an empty string
std::vector<FileEntry> list_folder(const std::filesystem::path& folder, std::string_view extension,
                                   std::string& error);

/// A path that a user types.
struct TypedPath {
    std::filesystem::path folder; ///< absolute
    std::string beginning;        ///< of a name in the folder; may be empty
};
/// Splits a typed path after its last slash. "~" is the home folder; without a folder it is the current one. An
/// absolute path typed after a folder ("/tmp//home/x.xml") replaces the folder.
TypedPath typed_path(const std::string& text);
/// Returns the absolute path of a typed file.
std::filesystem::path typed_file(const std::string& text);

/// Returns the path relative to the current folder if the file lies in it or below; otherwise `file`.
std::string short_path(const std::string& file);

/// Returns the entries whose names start with `beginning`, ignoring case; hidden ones only if it starts with a
/// dot.
std::vector<FileEntry> beginning_with(const std::vector<FileEntry>& entries, const std::string& beginning);

/// Returns the longest common prefix of the names, for completion; with a "/" for a single folder.
std::string common_beginning(const std::vector<FileEntry>& entries);

} // namespace tessera
