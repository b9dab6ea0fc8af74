#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include <sys/wait.h>

namespace tessera::test {

struct Outcome {
    int exit_code = -1;
    std::string output;
};

/// Runs the program in `folder` with both output streams in one.
inline Outcome run(const std::filesystem::path& folder, const std::string& arguments) {
    const std::string command = "unset DISPLAY WAYLAND_DISPLAY; cd '" + folder.string() + "' && '" +
                                std::string(TESSERA_BINARY) + "' " + arguments + " 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    Outcome outcome;
    std::array<char, 4096> buffer;
    while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
        outcome.output.append(buffer.data(), n);
    const int status = pclose(pipe);
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
}

} // namespace tessera::test
