#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tessera::test {

struct Outcome {
    int exit_code = -1;
    std::string output;
};

/// Runs the program in `folder`. The output combines stdout and stderr.
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

/// Runs the program in `folder` without output. Returns its peak resident memory in bytes, or 0 if it fails.
inline std::size_t peak_memory(const std::filesystem::path& folder, const std::string& arguments) {
    const std::string command = "cd '" + folder.string() + "' && exec '" + std::string(TESSERA_BINARY) + "' " +
                                arguments + " >/dev/null 2>&1";
    const pid_t child = ::fork();
    if (child == 0) {
        ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        ::_exit(127);
    }
    int status = 0;
    rusage usage{};
    const bool has_ended = ::wait4(child, &status, 0, &usage) == child && WIFEXITED(status);
    constexpr std::size_t kibibyte = 1024;
    return has_ended && WEXITSTATUS(status) == 0 ? static_cast<std::size_t>(usage.ru_maxrss) * kibibyte : 0;
}

} // namespace tessera::test
