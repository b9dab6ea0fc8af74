#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "render/io/available_memory.h"

#include <cstdio>
#include <exception>
#include <new>

#include <fmt/core.h>
#include <malloc.h>

namespace {

/// Pictures come and go with every solve. What they leave is kept for the next: pages that the system has to clear
/// anew cost a tenth of a reconstruction.
void keep_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 64 << 20);
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

} // namespace

/// One message and an exit code for whatever goes wrong: nobody is left with a stack trace.
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
