#include "ui/output_files.h"

#include "render/load/temporary_file.h"

#include <ctime>
#include <fstream>
#include <stdexcept>

namespace tessera {

std::filesystem::path dated_file(const std::string& ending) {
    const std::time_t now = std::time(nullptr);
    char stem[32];
    std::strftime(stem, sizeof stem, "tessera-%Y%m%d-%H%M%S", std::localtime(&now));
    return std::filesystem::current_path() / (stem + ending);
}

std::string write_dated(const std::string& ending, const std::string& text) {
    const std::filesystem::path file = dated_file(ending);
    write_text_file(file, text);
    return file.string();
}

void write_text_file(const std::filesystem::path& path, const std::string& text) {
    TemporaryFile temporary(path);
    std::ofstream out(temporary.path(), std::ios::binary);
    out << text;
    out.close();
    if (!out)
        throw std::runtime_error(path.string() + ": cannot be written");
    temporary.commit();
}

} // namespace tessera
