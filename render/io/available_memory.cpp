#include "render/io/available_memory.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string_view>

#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

namespace tessera {

namespace {

constexpr std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max();

/// Returns the first number of the line that begins with `name` in a system file; `unknown` if there is none,
/// as for "max".
std::uint64_t number_in(const std::filesystem::path& file, std::string_view name = "") {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with(name))
            continue;
        const std::size_t digits = line.find_first_of("0123456789", name.size());
        return digits == line.npos ? unknown : std::strtoull(line.c_str() + digits, nullptr, 10);
    }
    return unknown;
}

std::uint64_t remaining(std::uint64_t limit, std::uint64_t used) {
    if (limit == unknown || used == unknown)
        return unknown;
    return limit - std::min(limit, used);
}

std::uint64_t free_in_machine() {
    const std::uint64_t kib = number_in("/proc/meminfo", "MemAvailable:");
    return kib == unknown ? unknown : kib * 1024;
}

/// Returns the memory that this process's control group and its ancestors leave. Inactive file pages count as
/// free, because the system can reclaim them.
std::uint64_t free_in_control_groups() {
    std::uint64_t left = unknown;
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        const bool is_unified = line.starts_with("0::");
        const std::size_t end = line.rfind(':');
        if (!is_unified && line.find(":memory:") == line.npos)
            continue;
        const std::filesystem::path root = is_unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
        const char* const limit = is_unified ? "memory.max" : "memory.limit_in_bytes";
        const char* const used = is_unified ? "memory.current" : "memory.usage_in_bytes";
        for (std::filesystem::path group = line.substr(end + 1);; group = group.parent_path()) {
            const std::filesystem::path folder = root / group.relative_path();
            const std::uint64_t files =
                number_in(folder / "memory.stat", is_unified ? "inactive_file" : "total_inactive_file");
            const std::uint64_t taken = number_in(folder / used);
            const bool knows_files = taken != unknown && files != unknown;
            left = std::min(
                left, remaining(number_in(folder / limit), knows_files ? taken - std::min(taken, files) : taken));
            if (group == group.parent_path())
                break;
        }
    }
    return left;
}

std::uint64_t free_in_address_space() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return unknown;
    const std::uint64_t pages = number_in("/proc/self/statm");
    return remaining(limit.rlim_cur,
                     pages == unknown ? unknown : pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)));
}

/// Returns the bytes that this process can allocate; `unknown` if the system does not say.
std::uint64_t available_memory() {
    return std::min({free_in_machine(), free_in_control_groups(), free_in_address_space()});
}

/// Formats bytes as "1.5 GiB" or "20 MiB".
std::string memory_text(std::uint64_t bytes) {
    constexpr double mib = 1 << 20, gib = 1 << 30;
    const auto size = static_cast<double>(bytes);
    return size < gib ? fmt::format("{:.0f} MiB", size / mib) : fmt::format("{:.1f} GiB", size / gib);
}

constexpr std::uint64_t smallest_checked = 1 << 20; // bytes; smaller requests skip the slow check; not tuned

} // namespace

bool has_free_memory(std::uint64_t bytes) {
    return bytes < smallest_checked || bytes <= available_memory();
}

void require_memory(std::uint64_t bytes, const std::string& what) {
    if (bytes < smallest_checked)
        return;
    const std::uint64_t available = available_memory();
    if (bytes > available)
        throw OutOfMemory(fmt::format("{} need {} of memory, and {} are free", what, memory_text(bytes),
                                      memory_text(available)));
}

std::string message_of(const std::exception& error) {
    return dynamic_cast<const std::bad_alloc*>(&error) ? "there is not enough memory" : error.what();
}

} // namespace tessera
