#pragma once

#include "recon/parallel.h"
#include "render/load/mitsuba_xml.h"
#include "render/load/properties.h"
#include "render/load/scene_source.h"
#include "render/load/xml_document.h"
#include "render/scene/scene.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace tessera {

/// Where the files that a scene names are looked for: beside the file that names them, then in the folders that
/// the scene adds (<path value="..."/>; the latest first), then beside the scene itself. Files outside of these
/// folders may be named, too ("../textures/wood.png", "/models/chair.ply"): scenes share them that way, and they
/// are only read.
class FileSearch {
public:
    /// `scene` is where files are named; null: a scene in memory, which has no files.
    explicit FileSearch(const XmlDocument* scene = nullptr) : scene_(scene) {}

    /// The path to the file that an element's attribute names; where there is none of that name, to one that is
    /// called so but for the case of letters, as on other systems. Throws LoadError when there is none.
    std::filesystem::path find(const XmlElement& element, const char* attribute) const;
    /// The file or folder of that name, found likewise; empty: there is none. Throws LoadError for what is no
    /// name.
    std::optional<std::filesystem::path> find_if_there(const XmlElement& element, const char* attribute) const;

    /// Adds the folder that a <path> names. Throws LoadError when there is none.
    void add_folder(const XmlElement& path);

private:
    std::vector<std::filesystem::path> candidates_for(const XmlElement& element, const char* attribute) const;
    std::filesystem::path find_existing(const XmlElement& element, const char* attribute) const;

    const XmlDocument* scene_;
    std::vector<std::filesystem::path> folders_;
};

/// The files that a scene names, read after the scene itself and all at once.
class FileJobs {
public:
    /// Reads a file and returns a note, or nothing. Ends with an exception soon after `wanted`, asked now and
    /// then, is false.
    using Read = std::function<std::string(const std::function<bool()>& wanted)>;

    /// `read` runs later, on any thread, once. `where` is the parameter that names the file: messages point at its
    /// value.
    void add(const XmlElement& where, Read read);

    /// Runs all jobs. Throws LoadError for the first in order of the file that failed, std::runtime_error if the
    /// scene is given up on the way.
    void run(const ParallelFor& parallel_for, std::vector<LoadNote>& notes, LoadProgress& progress) const;

private:
    struct Job {
        XmlElement where;
        Read read;
    };
    std::vector<Job> jobs_;
};

/// What the readers of plugins share while one scene is loaded.
struct LoadContext {
    SceneDescription scene;
    std::vector<LoadNote> notes;
    FileJobs jobs;

    bool old_syntax = false; ///< Mitsuba 0.x: some defaults differ
    bool strict = false;     ///< a file that is not there ends the load
    FileSearch files;

    /// Which shape of which list in `scene` is whose; the lists stay in place.
    struct LoadedShape {
        const std::vector<Shape>* shapes;
        std::size_t index;
        XmlElement element;
    };
    std::vector<LoadedShape> shapes;
    std::map<std::string, XmlElement> ids;
    std::set<std::string> referred;        ///< ids that some <ref> names
    std::map<const void*, int> materials;  ///< by XmlElement::key(), index into scene.materials
    std::map<const void*, int> groups;     ///< by XmlElement::key(), index into scene.groups
    std::map<const void*, Material> bsdfs; ///< by XmlElement::key(): what is referred to often is read once
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
    /// Where one has a meaning: the first of them, and a note for the second. Empty if there is none.
    std::optional<XmlElement> take_one_nested(Properties& properties, std::string_view tag) const;

    /// The file that the parameter "filename" names, and the parameter. Empty: there is none of that name, and a
    /// note says that `instead`, "grey stands for it". Throws LoadError where nothing is named, and where it is
    /// strict.
    struct File {
        XmlElement parameter;
        std::filesystem::path path;
    };
    std::optional<File> take_file(Properties& properties, std::string_view instead);
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

/// Goes through a scene once, in order, and
/// - replaces $name in all attributes by the value of the <default> of that name that stands before, or by that of
///   `given`, which wins;
/// - puts the files that <include> names in their places; they see the variables before them, and theirs are seen
///   after them;
/// - adds the folders of <path> to `files`.
/// Throws LoadError for an unknown name, a missing file, or files that include each other; notes the variables
/// given in vain.
void expand_scene(XmlDocument& document, const SceneVariables& given, FileSearch& files,
                  std::vector<LoadNote>& notes);

} // namespace tessera
