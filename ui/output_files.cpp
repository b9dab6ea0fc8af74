#include "ui/output_files.h"

#include <ctime>
#include <set>
#include <system_error>

namespace tessera {

std::filesystem::path dated_file(const std::string& ending) {
    static std::set<std::filesystem::path> given;
    const std::time_t now = std::time(nullptr);
    char stem[32];
    std::strftime(stem, sizeof stem, "tessera-%Y%m%d-%H%M%S", std::localtime(&now));
    std::error_code ignored; // a current folder that is gone shows when the file is to be written
    const std::filesystem::path folder = std::filesystem::current_path(ignored);
    std::filesystem::path file = folder / (stem + ending);
    for (int n = 2; given.count(file) > 0 || std::filesystem::exists(file, ignored); ++n)
        file = folder / (stem + ("-" + std::to_string(n)) + ending);
    given.insert(file);
    return file;
}

} // namespace tessera
