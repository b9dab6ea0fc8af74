// Files as a whole: they are read at once, and written so that there is never half a one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace tessera {

/// Whether there is a device, a pipe or the like at the path (or where its link leads): neither file nor folder.
bool is_special(const std::filesystem::path& path);

/// A file to be read from its beginning; throws std::runtime_error that says why, also for what is no regular
/// file: a device or a pipe may be of endless size, or keep who reads it waiting for ever.
std::ifstream open_file(const std::filesystem::path& file);

/// All of a file's bytes; throws std::runtime_error.
std::string read_bytes(const std::filesystem::path& file);

/// ".exr": the end of the file's name, in lower case.
std::string extension_of(const std::filesystem::path& file);

/// The largest image that is rendered, written or read, whatever its format. At the most pixels, byte counts of
/// 8-bit RGB still fit the int that the PNG encoder has for them.
inline constexpr int most_image_edge = 32768;
inline constexpr std::int64_t most_image_pixels = std::int64_t{1} << 28;

/// Throws std::runtime_error that says why where there can be no image of that size.
void check_image_size(std::int64_t width, std::int64_t height);

/// The same, and where a file of that many bytes cannot hold one.
void check_image_size(std::int64_t width, std::int64_t height, std::uintmax_t file_bytes);

/// A file that is written under a temporary name beside its own and takes its own name only when it is complete.
/// So whatever happens, there is never half a file under that name. A link is followed: it is the file at its end
/// that is written. What is there and no regular file, a device or a pipe, cannot be half a file, and must not
/// become one: it stays, and gets the bytes.
class TemporaryFile {
public:
    /// Removes what processes that were killed have left of the same file, as far as it is certain that they are
    /// no more: those that ran since this machine has started, and in this container. Throws
    /// std::filesystem::filesystem_error for links that lead to each other.
    explicit TemporaryFile(std::filesystem::path final_path);
    ~TemporaryFile(); ///< removes the file unless it was committed
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::filesystem::path& path() const { return temporary_; }

    /// The file is on the disk when it takes its name, and under that name when this returns: whatever is written
    /// later may rely on it, power cuts included. Into a pipe it waits for who reads it. Throws
    /// std::filesystem::filesystem_error.
    void commit();

private:
    std::filesystem::path final_;
    bool is_in_place_; // the bytes go into what is there
    std::filesystem::path temporary_;
};

/// Writes such a file and commits it. Throws std::runtime_error that names the file.
void write_text(const std::filesystem::path& path, const std::string& text);

/// Makes sure that what was last made or renamed in the folder is there after a power cut, where the file system
/// can.
void write_through_folder(const std::filesystem::path& folder);

/// Throws std::runtime_error that names the file where none can be made at `path`: better before a render than
/// after it. Touches no other file.
void check_writable(const std::filesystem::path& path);

} // namespace tessera
