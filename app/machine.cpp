#include "app/machine.h"

#include <fstream>

namespace tessera {

std::string cpu_model() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (const std::size_t colon = line.find(": "); line.rfind("model name", 0) == 0 && colon != line.npos)
            return line.substr(colon + 2);
    return "unknown";
}

} // namespace tessera
