#pragma once

#include "render/load/xml_document.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

/// Where the files that a scene names are looked for: beside the file that names them, then in the folders that
/// the scene adds (<path value="..."/>; the latest first), then beside the scene itself. Files outside of these
/// folders may be named, too ("../textures/wood.png", "/models/chair.ply"): scenes share them that way, and they
/// are only read.
class FileSearch {
public:
    /// Null: a scene in memory, which has no files.
    explicit FileSearch(const XmlDocument* scene = nullptr) : scene_(scene) {}

    /// The path to the file that an element's attribute names. Throws LoadError when there is none.
    std::filesystem::path find(const XmlElement& element, const char* attribute) const;

    /// Adds the folder that a <path> names. Throws LoadError when there is none.
    void add_folder(const XmlElement& path);

private:
    std::filesystem::path find_existing(const XmlElement& element, const char* attribute) const;

    const XmlDocument* scene_;
    std::vector<std::filesystem::path> folders_;
};

} // namespace tessera
