#include "render/load/scene_source.h"

namespace tessera {

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
        name += "-" + value;
    return name;
}

} // namespace tessera
