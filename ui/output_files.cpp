#include "ui/output_files.h"

#include <ctime>
#include <set>
#include <system_error>

namespace tessera {

std::filesystem::path free_name(const std::filesystem::path& stem, const std::string& ending,
                                const std::function<bool(const std::filesystem::path&)>& is_taken) {
    std::error_code ignored; // a folder that cannot be looked into shows when the file is to be written
    const auto is_there = [&](const std::filesystem::path& file) { // links to nowhere, too
        return std::filesystem::exists(std::filesystem::symlink_status(file, ignored));
    };
    std::filesystem::path file = stem.string() + ending;
    for (int n = 2; (is_taken && is_taken(file)) || is_there(file); ++n)
        file = stem.string() + "-" + std::to_string(n) + ending;
    return file;
}

std::filesystem::path dated_file(const std::string& ending) {
    static std::set<std::filesystem::path> given;
    const std::time_t now = std::time(nullptr);
    char stem[32];
    std::strftime(stem, sizeof stem, "tessera-%Y%m%d-%H%M%S", std::localtime(&now));
    std::error_code ignored; // a current folder that is gone shows when the file is to be written
    const std::filesystem::path folder = std::filesystem::current_path(ignored);
    const auto is_given = [](const std::filesystem::path& file) { return given.contains(file); };
    return *given.insert(free_name(folder / stem, ending, is_given)).first;
}

} // namespace tessera
