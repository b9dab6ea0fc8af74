#pragma once

#include <cstdint>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

namespace tessera {

/// Thrown if there is not enough memory.
class OutOfMemory : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Checks for free memory before a large allocation, because the system kills the program or swaps endlessly
/// when memory runs out. Throws OutOfMemory, such as "8192x8192 pixels of gpr need 12.1 GiB of memory, and 7.0
/// GiB are free", if the machine, the control group or the address space limit (ulimit -v) leaves fewer bytes.
/// `what` is in the plural.
void require_memory(std::uint64_t bytes, const std::string& what);

/// Returns whether that many bytes are free, for an optional allocation.
bool has_free_memory(std::uint64_t bytes);

/// Calls `work` and returns its result. Turns std::bad_alloc into OutOfMemory: "there is not enough memory for
/// loading box.xml", where `what` is "loading box.xml".
template <class Work>
decltype(auto) with_memory_for(const std::string& what, Work&& work) {
    try {
        return std::forward<Work>(work)();
    } catch (const std::bad_alloc&) {
        throw OutOfMemory("there is not enough memory for " + what);
    }
}

/// Returns an exception's message for users; std::bad_alloc becomes "there is not enough memory".
std::string message_of(const std::exception& error);

} // namespace tessera
