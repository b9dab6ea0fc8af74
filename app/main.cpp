#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "render/io/available_memory.h"

#include <cstdio>
#include <exception>
#include <new>

#include <fmt/core.h>

/// One message and an exit code for whatever goes wrong: nobody is left with a stack trace.
int main(int argc, char** argv) {
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
