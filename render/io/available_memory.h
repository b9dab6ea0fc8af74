#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace tessera {

/// There is not enough memory.
class OutOfMemory : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Memory is asked for before it is taken: where there is too little, the system either ends the program or slows
/// the machine to a halt, and nobody learns why. Throws OutOfMemory with the figures, "8192x8192 pixels of gpr
/// need 12.1 GiB of memory, and 7.0 GiB are free", where the machine, the control group or the limit of address
/// space (ulimit -v) leaves fewer `bytes`. `what` is in the plural.
void ask_for_memory(std::uint64_t bytes, const std::string& what);

} // namespace tessera
