#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace tessera {

/// Bytes that this process can still take: what the machine has free, as far as neither its control group nor its
/// limit of address space (ulimit -v) leaves less. The largest number where the system does not say.
std::uint64_t available_memory();

/// There is not enough memory.
class OutOfMemory : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Memory is asked for before it is taken: where there is too little, the system either ends the program or slows
/// the machine to a halt, and nobody learns why. Throws OutOfMemory with the figures, "8192x8192 pixels of gpr
/// need 12.1 GiB of memory, and 7.0 GiB are free", where `bytes` cannot be had. `what` is in the plural.
void ask_for_memory(std::uint64_t bytes, const std::string& what);

/// "1.5 GiB", "20 MiB", for people.
std::string memory_text(std::uint64_t bytes);

} // namespace tessera
