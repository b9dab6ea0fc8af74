#include "render/load/file_search.h"

#include <system_error>

namespace tessera {

namespace fs = std::filesystem;

fs::path FileSearch::find_existing(const XmlElement& element, const char* attribute) const {
    const std::string name = element.required(attribute);
    if (!scene_ || !scene_->folder() || !element.document().folder())
        element.fail("a scene in memory has no files beside it, such as '" + name + "'", attribute);
    if (name.find('\0') != std::string::npos || name.empty())
        element.fail("'" + name + "' is no name of a file", attribute);
    std::vector<fs::path> candidates{*element.document().folder() / name};
    for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder)
        candidates.push_back(*folder / name);
    candidates.push_back(*scene_->folder() / name);
    std::error_code error;
    for (const fs::path& candidate : candidates)
        if (fs::exists(candidate, error))
            return candidate;
    element.fail("there is no file '" + candidates.front().string() + "'", attribute);
}

fs::path FileSearch::find(const XmlElement& element, const char* attribute) const {
    const fs::path path = find_existing(element, attribute);
    std::error_code error;
    if (!fs::is_regular_file(path, error))
        element.fail("'" + path.string() + "' is not a file", attribute);
    return path;
}

void FileSearch::add_folder(const XmlElement& path) {
    const fs::path folder = find_existing(path, "value");
    std::error_code error;
    if (!fs::is_directory(folder, error))
        path.fail("'" + folder.string() + "' is not a folder", "value");
    folders_.push_back(folder);
}

} // namespace tessera
