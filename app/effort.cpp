#include "app/effort.h"

#include <fmt/core.h>

namespace tessera {

std::string to_string(const Effort& effort) {
    const char* const units[] = {"spp", "CPU s", "s"};
    return fmt::format("{:g} {}", effort.amount, units[static_cast<int>(effort.unit)]);
}

} // namespace tessera
