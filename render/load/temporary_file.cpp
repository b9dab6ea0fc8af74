#include "render/load/temporary_file.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace tessera {

namespace {

/// The process that made "NAME.PID-COUNT.tmp" for this NAME; 0: it is no such file.
int maker_of(const std::string& file, const std::string& name) {
    int process = 0, count = 0, used = 0;
    if (file.rfind(name + ".", 0) != 0 ||
        std::sscanf(file.c_str() + name.size(), ".%d-%d.tmp%n", &process, &count, &used) != 2)
        return 0;
    return name.size() + static_cast<std::size_t>(used) == file.size() ? process : 0;
}

void remove_leftovers(const std::filesystem::path& final_path) {
    std::error_code ignored;
    const std::filesystem::path folder = final_path.has_parent_path() ? final_path.parent_path() : ".";
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const int process = maker_of(entry.path().filename().string(), final_path.filename().string());
        if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH)
            std::filesystem::remove(entry.path(), ignored);
    }
}

/// What the system still holds of a file or folder goes to the disk, if it can be had.
void write_through(const std::filesystem::path& path) {
    if (const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC); file >= 0) {
        ::fsync(file);
        ::close(file);
    }
}

} // namespace

TemporaryFile::TemporaryFile(std::filesystem::path final_path) : final_(std::move(final_path)) {
    remove_leftovers(final_);
    static std::atomic<int> count = 0;
    temporary_ = final_;
    temporary_ += "." + std::to_string(::getpid()) + "-" + std::to_string(++count) + ".tmp";
}

TemporaryFile::~TemporaryFile() {
    std::error_code ignored;
    if (!temporary_.empty())
        std::filesystem::remove(temporary_, ignored);
}

void TemporaryFile::commit() {
    // On the disk before it takes the old one's place: else a power cut could leave neither.
    write_through(temporary_);
    std::filesystem::rename(temporary_, final_);
    write_through(final_.has_parent_path() ? final_.parent_path() : ".");
    temporary_.clear();
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    TemporaryFile temporary(path);
    std::ofstream out(temporary.path(), std::ios::binary);
    out << text;
    out.close();
    if (!out)
        throw std::runtime_error(path.string() + ": cannot be written");
    temporary.commit();
}

void check_writable(const std::filesystem::path& path) {
    if (std::filesystem::is_directory(path))
        throw std::runtime_error(path.string() + ": is a folder, not a file to write to");
    // Trying is the only test that holds for root, full disks and odd file systems alike.
    const std::filesystem::path trial = path.string() + ".part";
    const bool made = static_cast<bool>(std::ofstream(trial, std::ios::binary));
    const std::string reason = std::strerror(errno);
    if (!made)
        throw std::runtime_error(path.string() + ": cannot be written: " + reason);
    std::filesystem::remove(trial);
}

} // namespace tessera
