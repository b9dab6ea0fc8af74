#include "app/cli/machine.h"

#include "render/io/memory.h"

#include <ctime>
#include <fstream>
#include <iterator>
#include <thread>

#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

namespace tessera {

namespace {

double seconds(timeval t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

rusage usage() {
    rusage u{};
    getrusage(RUSAGE_SELF, &u);
    return u;
}

} // namespace

double process_cpu_seconds() {
    const rusage u = usage();
    return seconds(u.ru_utime) + seconds(u.ru_stime);
}

double peak_memory_bytes() {
    return 1024.0 * static_cast<double>(usage().ru_maxrss);
}

std::string cpu_model() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (const std::size_t colon = line.find(": "); line.rfind("model name", 0) == 0 && colon != line.npos)
            return line.substr(colon + 2);
    return "unknown";
}

std::string machine_text() {
    std::string text = fmt::format("{}, {} hardware threads", cpu_model(), std::thread::hardware_concurrency());
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    if (pages > 0 && page > 0)
        text += fmt::format(", {:.0f} GB", static_cast<double>(pages) * static_cast<double>(page) * 1e-9);
    return text;
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    return fmt::format("{:04}-{:02}-{:02}", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday);
}

const std::string& program_identity() {
    static const std::string identity = [] {
        std::ifstream in("/proc/self/exe", std::ios::binary);
        const std::string program{std::istreambuf_iterator<char>(in), {}};
        return fmt::format("{} {:08x}", TESSERA_VERSION,
                           checksum(std::as_bytes(std::span(program.data(), program.size()))));
    }();
    return identity;
}

} // namespace tessera
