#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "render/io/available_memory.h"

#include <cstdio>
#include <exception>
#include <new>

#include <fmt/core.h>
#include <malloc.h>

namespace {

/// Keeps freed memory of pictures for the next reconstruction. Getting zeroed pages from the system again costs
/// about 10 % of its time.
void keep_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 64 << 20);
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

} // namespace

/// Reports every error in one message, with an exit code.
int main(int argc, char** argv) {
    keep_memory();
    try {
        return tessera::run_command_line(argc, argv);
    } catch (const tessera::OutOfMemory& error) {
        fmt::print(stderr, "tessera: {}\n", error.what());
        return tessera::exit_failure;
    } catch (const std::bad_alloc& error) {
        fmt::print(stderr, "tessera: {}\n", tessera::message_of(error));
        return tessera::exit_failure;
    } catch (const std::exception& error) {
        fmt::print(stderr, "tessera: {}\n", error.what());
        return tessera::exit_bad_input;
    }
}
