#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

struct FileEntry {
    std::string name;
    bool is_folder = false;

    bool operator==(const FileEntry&) const = default;
};

/// ".xml", in either case.
bool has_extension(const std::filesystem::path& file, std::string_view extension);

/// What is in a folder: other folders first, then the files with the extension (".xml", in either case), both by
/// name. `error` says why it cannot be read; else it is empty.
std::vector<FileEntry> list_folder(const std::filesystem::path& folder, std::string_view extension,
                                   std::string& error);

/// What a user has typed of a path.
struct TypedPath {
    std::filesystem::path folder; ///< in full; "~" is the home folder, and no folder the current one
    std::string beginning;        ///< of a name in it
};
TypedPath typed_path(const std::string& text);
/// The same in one.
std::filesystem::path typed_file(const std::string& text);

/// Those whose names begin so, in either case; hidden ones only where the beginning has their dot.
std::vector<FileEntry> beginning_with(const std::vector<FileEntry>& entries, const std::string& beginning);

/// The longest beginning that all of them share: what a completion makes of what was typed. With a "/" where it is
/// a single folder's.
std::string common_beginning(const std::vector<FileEntry>& entries);

} // namespace tessera
