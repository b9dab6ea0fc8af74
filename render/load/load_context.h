#pragma once

#include "render/load/file_jobs.h"
#include "render/load/file_search.h"
#include "render/load/properties.h"
#include "render/load/xml_document.h"
#include "render/scene/scene.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace tessera {

/// What the readers of plugins share while one scene is loaded.
struct LoadContext {
    SceneDescription scene;
    std::vector<LoadNote> notes;
    FileJobs jobs;

    bool old_syntax = false; ///< Mitsuba 0.x: some defaults differ
    FileSearch files;

    std::map<std::string, XmlElement> ids;
    std::map<const void*, int> materials; ///< by XmlElement::key(), index into scene.materials
    std::map<std::pair<std::string, bool>, std::shared_ptr<Bitmap>> bitmaps; ///< by path and whether sRGB
    std::map<std::tuple<float, MicrofacetDistribution, float>, std::shared_ptr<const Coating>>
        coatings;  ///< by index of refraction, distribution and alpha: they take time to make
    int depth = 0; ///< of nested plugins being read, to find circles of references

    /// The element that a <ref> means; any other element itself. Throws LoadError for an unknown id.
    XmlElement resolve(const XmlElement& element) const;
    /// The element whose id is this element's attribute "id". Throws LoadError.
    XmlElement resolve_id(const XmlElement& element) const;

    /// The nested plugins with that tag, references to such included.
    std::vector<XmlElement> take_nested(Properties& properties, std::string_view tag) const;

    /// The file that the parameter "filename" names, and the parameter. Throws LoadError when there is none.
    struct File {
        XmlElement parameter;
        std::filesystem::path path;
    };
    File take_file(Properties& properties) const;
};

/// One more level of nested plugins; throws LoadError at a depth that only a circle of references reaches.
class NestingGuard {
public:
    NestingGuard(LoadContext& context, const XmlElement& element);
    ~NestingGuard() { --context_.depth; }
    NestingGuard(const NestingGuard&) = delete;
    NestingGuard& operator=(const NestingGuard&) = delete;

private:
    LoadContext& context_;
};

} // namespace tessera
