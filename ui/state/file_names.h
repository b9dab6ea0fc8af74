#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// The first of "STEM" + ending, "STEM-2" + ending, "STEM-3" + ending ... that is not there, and not taken either.
/// @param is_taken  may be empty
std::filesystem::path free_name(const std::filesystem::path& stem, const std::string& ending = "",
                                const std::function<bool(const std::filesystem::path&)>& is_taken = {});

/// A file in the folder (empty: the current one) that is named after what it is and the time:
/// "tessera-20260131-120000.png", or "tessera-20260131-120000-2.png" if that is there, or this process has got the
/// name before, though it may not have written to it yet. To be called from one thread.
/// @param ending  "-charts.csv", ".png"
std::filesystem::path dated_file(const std::string& ending, const std::filesystem::path& folder = {});

struct FileEntry {
    std::string name;
    bool is_folder = false;

    bool operator==(const FileEntry&) const = default;
};

/// Whether the file has the extension (".xml"), in either case.
bool has_extension(const std::filesystem::path& file, std::string_view extension);

/// What is in a folder: other folders first, then the files with the extension (".xml", in either case), both by
/// name. `error` says why it cannot be read; else it is empty.
std::vector<FileEntry> list_folder(const std::filesystem::path& folder, std::string_view extension,
                                   std::string& error);

/// What a user has typed of a path. Where a whole one follows a folder, it counts alone.
struct TypedPath {
    std::filesystem::path folder; ///< in full; "~" is the home folder, and no folder the current one
    std::string beginning;        ///< of a name in it
};
TypedPath typed_path(const std::string& text);
/// The path that was typed: a name in a folder.
std::filesystem::path typed_file(const std::string& text);

/// A file as it is called from the current folder, if it lies in that or below; else as it is given.
std::string short_path(const std::string& file);

/// The entries whose names begin so, in either case; hidden ones only where the beginning has their dot.
std::vector<FileEntry> beginning_with(const std::vector<FileEntry>& entries, const std::string& beginning);

/// The longest beginning that all of them share: what a completion makes of what was typed. With a "/" where it is
/// a single folder's.
std::string common_beginning(const std::vector<FileEntry>& entries);

} // namespace tessera
