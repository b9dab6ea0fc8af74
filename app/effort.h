#pragma once

#include <string>

namespace tessera {

/// How much a render is given.
struct Effort {
    enum class Unit { spp, cpu_seconds, wall_seconds };

    double amount = 64;
    Unit unit = Unit::spp;

    bool operator==(const Effort&) const = default;
};

/// "64 spp", "60 CPU s", "60 s".
std::string to_string(const Effort& effort);

} // namespace tessera
