#include "app/cli/picture_names.h"

#include <map>

#include <fmt/core.h>

namespace tessera {

namespace {

std::filesystem::path with_stem(const std::filesystem::path& output, const std::string& stem) {
    return output.parent_path() / (stem + output.extension().string());
}

} // namespace

std::filesystem::path frame_name(const std::filesystem::path& output, int number) {
    const std::string stem = output.stem().string();
    const std::size_t last = stem.rfind('#');
    if (last == std::string::npos)
        return with_stem(output, fmt::format("{}-{:04}", stem, number));
    const std::size_t before = stem.find_last_not_of('#', last),
                      first = before == std::string::npos ? 0 : before + 1;
    return with_stem(
        output, fmt::format("{}{:0{}}{}", stem.substr(0, first), number, last + 1 - first, stem.substr(last + 1)));
}

std::vector<std::filesystem::path> scene_outputs(const std::filesystem::path& output,
                                                 const std::vector<std::string>& scenes) {
    if (scenes.size() == 1 || output.empty())
        return std::vector(scenes.size(), output);
    std::vector<std::filesystem::path> files;
    std::map<std::string, int> uses;
    for (const std::string& scene : scenes) {
        const int use = ++uses[scene];
        files.push_back(with_stem(output, fmt::format("{}-{}{}", output.stem().string(), scene,
                                                      use > 1 ? fmt::format("-{}", use) : "")));
    }
    return files;
}

} // namespace tessera
