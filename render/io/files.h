// Reading of whole files, and writing that never leaves an incomplete file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace tessera {

/// Returns whether the path (or the end of its link) is a device, a pipe or the like: neither file nor folder.
bool is_special(const std::filesystem::path& path);

/// Opens a file for reading. Throws std::runtime_error with the reason, also for devices and pipes, which may
/// be endless or block the reader forever.
std::ifstream open_file(const std::filesystem::path& file);

/// Reads a whole file. Throws std::runtime_error.
std::string read_bytes(const std::filesystem::path& file);

/// Returns the extension of a file name in lower case, such as ".exr".
std::string extension_of(const std::filesystem::path& file);

/// Largest image that is rendered, written or read, in any format. Byte counts of 8-bit RGB then fit the int
/// that the PNG encoder uses.
inline constexpr int max_image_edge = 32768;
inline constexpr std::int64_t max_image_pixels = std::int64_t{1} << 28;

/// Throws std::runtime_error with the reason if no image may have that size (in pixels).
void check_image_size(std::int64_t width, std::int64_t height);

/// Does the same, and also throws if a file of that many bytes cannot hold such an image.
void check_image_size(std::int64_t width, std::int64_t height, std::uintmax_t file_bytes);

/// A file that is written under a temporary name in the same folder, and gets its final name when it is
/// complete. So the final name never belongs to an incomplete file. A link is followed, and the file at its end
/// is replaced. An existing device or pipe is not replaced: it receives the bytes.
class TemporaryFile {
public:
    /// Removes temporary files that killed processes left of the same file. It removes only files of processes
    /// that are certainly dead: those of this machine since boot, and of this container. Throws
    /// std::filesystem::filesystem_error for a circle of links.
    explicit TemporaryFile(std::filesystem::path final_path);
    ~TemporaryFile(); ///< removes the temporary file unless committed
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::filesystem::path& path() const { return temporary_; }

    /// Syncs the file to disk, renames it, and syncs the folder: later writes may rely on it even after a power
    /// cut. Blocks on a pipe until it is read. Throws std::filesystem::filesystem_error.
    void commit();

private:
    std::filesystem::path final_;
    bool is_in_place_; // `final_` is a device or pipe, which gets the bytes
    std::filesystem::path temporary_;
};

/// Writes a text to a TemporaryFile and commits it. Throws std::runtime_error that names the file.
void write_text(const std::filesystem::path& path, const std::string& text);

/// Syncs a folder, so that its last creations and renames survive a power cut, if the file system supports it.
void sync_folder(const std::filesystem::path& folder);

/// Throws std::runtime_error that names the file if it cannot be written. Call it before a render, not only
/// after. Changes no other file.
void check_writable(const std::filesystem::path& path);

} // namespace tessera
