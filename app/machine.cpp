#include "app/machine.h"

#include "render/checksum.h"

#include <fstream>
#include <iterator>

#include <fmt/core.h>

namespace tessera {

std::string cpu_model() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (const std::size_t colon = line.find(": "); line.rfind("model name", 0) == 0 && colon != line.npos)
            return line.substr(colon + 2);
    return "unknown";
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
