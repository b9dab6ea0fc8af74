#include "render/io/files.h"

#include "render/io/available_memory.h"
#include "render/io/memory.h"
#include "render/io/text.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace tessera {

namespace {

// No format exceeds it: PNG packs 8 pixels into a byte, and DEFLATE 1032 bytes into one.
constexpr std::uintmax_t max_pixels_per_byte = std::uintmax_t{1} << 14;

} // namespace

std::string extension_of(const std::filesystem::path& file) {
    return lower_case(file.extension().string());
}

namespace {
std::string size_text(std::int64_t width, std::int64_t height) {
    return std::to_string(width) + " by " + std::to_string(height) + " pixels";
}
} // namespace

void check_image_size(std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1)
        throw std::runtime_error("an image of " + size_text(width, height) + " is empty");
    if (width > max_image_edge || height > max_image_edge || width * height > max_image_pixels)
        throw std::runtime_error("an image of " + size_text(width, height) + " is too large: at most " +
                                 std::to_string(max_image_edge) + " pixels along an edge, and " +
                                 std::to_string(max_image_pixels) + " in all");
}

void check_image_size(std::int64_t width, std::int64_t height, std::uintmax_t file_bytes) {
    check_image_size(width, height);
    if (static_cast<std::uintmax_t>(width * height) / max_pixels_per_byte > file_bytes)
        throw std::runtime_error("the file is too short for " + size_text(width, height));
}

bool is_special(const std::filesystem::path& path) {
    std::error_code none;
    const std::filesystem::file_status status = std::filesystem::status(path, none);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
           !std::filesystem::is_directory(status);
}

std::ifstream open_file(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) // a folder opens like a file, with an endless size
        throw std::runtime_error("this is a folder, not a file");
    if (is_special(file))
        throw std::runtime_error("this is a device or a pipe, not a file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw std::runtime_error(std::string("cannot open the file: ") + std::strerror(errno));
    return stream;
}

std::string read_bytes(const std::filesystem::path& file) {
    std::ifstream stream = open_file(file);
    stream.seekg(0, std::ios::end);
    const std::streamoff size = stream.tellg();
    if (size < 0)
        throw std::runtime_error("the file cannot be read");
    require_memory(static_cast<std::uint64_t>(size), "the bytes of the file");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    stream.seekg(0);
    if (!stream.read(bytes.data(), size))
        throw std::runtime_error("the file cannot be read");
    return bytes;
}

namespace {

/// Returns eight hexadecimal digits that identify the space of process ids: this machine since boot, and this
/// container (pid namespace). Several machines and containers may write to one folder, and cannot see each
/// other's processes. Temporary files of other spaces are left alone, so somebody has to remove what a power
/// cut leaves. Advisory locks would not do: some network file systems grant them per machine.
const std::string& process_space() {
    static const std::string space = [] {
        std::string machine;
        std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), machine);
        std::error_code unknown;
        const std::string container = std::filesystem::read_symlink("/proc/self/ns/pid", unknown).string();
        std::uint32_t sum = std::random_device()(); // matches no other process, so nothing is removed
        if (!machine.empty() && !unknown)
            sum = checksum(std::as_bytes(std::span(container)), checksum(std::as_bytes(std::span(machine))));
        char digits[9];
        std::snprintf(digits, sizeof digits, "%08x", sum);
        return std::string(digits);
    }();
    return space;
}

/// Returns the process of this id space that made "NAME.SPACE-PID-COUNT.tmp" for this NAME; 0: not such a file.
int creator_of(const std::string& file, const std::string& name) {
    const std::string begin = name + "." + process_space();
    int process = 0, count = 0, used = 0;
    if (!file.starts_with(begin) ||
        std::sscanf(file.c_str() + begin.size(), "-%d-%d.tmp%n", &process, &count, &used) != 2)
        return 0;
    return begin.size() + static_cast<std::size_t>(used) == file.size() ? process : 0;
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

/// Returns the end of a chain of links, which need not exist; the path itself if it is no link. The system
/// resolves links among its parent folders.
std::filesystem::path end_of_links(const std::filesystem::path& path) {
    constexpr int max_links = 40; // as in Linux
    std::filesystem::path end = path;
    std::error_code none;
    for (int i = 0; std::filesystem::is_symlink(std::filesystem::symlink_status(end, none)); ++i) {
        if (i == max_links)
            throw std::filesystem::filesystem_error(
                "cannot be written", path, std::make_error_code(std::errc::too_many_symbolic_link_levels));
        end = folder_of(end) / std::filesystem::read_symlink(end);
    }
    return end;
}

/// Appends a file's content to an existing device or pipe.
void append_content(const std::filesystem::path& from, const std::filesystem::path& into) {
    std::ofstream out(into, std::ios::binary | std::ios::app);
    if (std::filesystem::file_size(from) > 0) // << fails for an empty buffer
        out << std::ifstream(from, std::ios::binary).rdbuf();
    out.close();
    if (!out)
        throw std::filesystem::filesystem_error("cannot be written", into, {errno, std::generic_category()});
}

void remove_leftovers(const std::filesystem::path& final_path) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder_of(final_path), ignored)) {
        const int process = creator_of(entry.path().filename().string(), final_path.filename().string());
        if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH)
            std::filesystem::remove(entry.path(), ignored);
    }
}

/// Syncs a file or folder to disk. Returns the error, or 0. EINVAL counts as success: some file systems cannot
/// sync.
int sync_to_disk(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return errno;
    const int error = ::fsync(file) == 0 || errno == EINVAL ? 0 : errno;
    ::close(file);
    return error;
}

} // namespace

TemporaryFile::TemporaryFile(std::filesystem::path final_path)
    : final_(end_of_links(final_path)), is_in_place_(is_special(final_)),
      temporary_(is_in_place_ ? std::filesystem::temp_directory_path() / final_.filename() : final_) {
    remove_leftovers(temporary_);
    static std::atomic<int> count = 0;
    temporary_ +=
        "." + process_space() + "-" + std::to_string(::getpid()) + "-" + std::to_string(++count) + ".tmp";
}

TemporaryFile::~TemporaryFile() {
    std::error_code ignored;
    if (!temporary_.empty())
        std::filesystem::remove(temporary_, ignored);
}

void TemporaryFile::commit() {
    if (is_in_place_)
        return append_content(temporary_, final_);
    // The file must be on disk before it replaces the old one; otherwise a power cut could lose both. A full or
    // broken disk may report its error only here.
    if (const int error = sync_to_disk(temporary_))
        throw std::filesystem::filesystem_error("cannot be written", final_, {error, std::generic_category()});
    std::filesystem::rename(temporary_, final_);
    sync_folder(folder_of(final_));
    temporary_.clear();
}

void sync_folder(const std::filesystem::path& folder) {
    sync_to_disk(folder); // an error is ignored: the folder may be unreadable
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    TemporaryFile temporary(path);
    std::ofstream out(temporary.path(), std::ios::binary);
    out << text;
    out.close();
    if (!out)
        throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(errno));
    temporary.commit();
}

void check_writable(const std::filesystem::path& path) {
    if (std::filesystem::is_directory(path))
        throw std::runtime_error(path.string() + ": is a folder, not a file to write to");
    // Only trying works for root, full disks and unusual file systems. The trial uses a temporary name
    // beside the file, which no other run has.
    const TemporaryFile trial(path);
    const bool can_be_written = is_special(path) ? ::access(path.c_str(), W_OK) == 0
                                                 : std::ofstream(trial.path(), std::ios::binary).good();
    if (!can_be_written)
        throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(errno));
}

} // namespace tessera
