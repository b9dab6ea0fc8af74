#include "render/load/scene_source.h"

#include <cctype>

namespace tessera {

namespace {

/// A value may be a path, or anything else: what could mean something in a file's name becomes "_".
std::string word(const std::string& text) {
    std::string word = text;
    for (char& c : word)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-')
            c = '_';
    return word;
}

} // namespace

std::string to_string(const SceneSource& source) {
    return source.file.empty() ? "the built-in Cornell box" : source.file.string();
}

std::string scene_name(const SceneSource& source) {
    if (source.file.empty())
        return "cornell-box";
    const std::string stem = source.file.stem().string();
    const std::string folder =
        std::filesystem::absolute(source.file).lexically_normal().parent_path().filename().string();
    std::string name = stem.rfind("scene", 0) == 0 && !folder.empty() ? folder : stem;
    for (const auto& [variable, value] : source.variables)
        name += "-" + word(value);
    return name;
}

} // namespace tessera
