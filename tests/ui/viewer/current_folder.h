#pragma once

#include <filesystem>
#include <string>

#include <unistd.h>

namespace tessera::test {

/// A temporary folder that is the current one during the object's lifetime.
struct CurrentFolder {
    CurrentFolder() {
        std::filesystem::create_directories(path);
        std::filesystem::current_path(path);
    }
    ~CurrentFolder() {
        std::filesystem::current_path(before);
        std::filesystem::remove_all(path);
    }
    CurrentFolder(const CurrentFolder&) = delete;
    CurrentFolder& operator=(const CurrentFolder&) = delete;

    std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("tessera-files-" + std::to_string(::getpid()));
};

} // namespace tessera::test
