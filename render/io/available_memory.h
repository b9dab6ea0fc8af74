#pragma once

#include <cstdint>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

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

/// Whether so many can be taken, for what can be done without.
bool is_memory_free(std::uint64_t bytes);

/// Does `work`, and returns what it returns. Where memory ends in the midst of it, unforeseen, throws OutOfMemory
/// that says during what: "there is not enough memory for loading box.xml".
template <class Work>
decltype(auto) with_memory_for(const std::string& what, Work&& work) {
    try {
        return std::forward<Work>(work)();
    } catch (const std::bad_alloc&) {
        throw OutOfMemory("there is not enough memory for " + what);
    }
}

/// What an exception says, for people: of itself, std::bad_alloc says "std::bad_alloc".
std::string message_of(const std::exception& error);

} // namespace tessera
