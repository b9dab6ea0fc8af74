#pragma once

#include "recon/parallel.h"
#include "render/load/mitsuba_xml.h"
#include "render/load/properties.h"
#include "render/load/scene_source.h"
#include "render/load/xml_document.h"
#include "render/mesh/mesh_file.h"
#include "render/scene/scene.h"

#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <pugixml.hpp>

namespace tessera {

/// Finds the files that a scene names. It searches the folder of the naming document, then the folders of
/// <path> elements (latest first), then the folder of the scene. Names may lead outside these folders
/// ("../textures/wood.png", "/models/chair.ply"), because scenes share files that way, and files are only read.
class FileSearch {
public:
    /// `scene` is the outermost document; null or without a folder: no files can be found.
    explicit FileSearch(const XmlDocument* scene = nullptr) : scene_(scene) {}

    /// Returns the path of the regular file that an attribute names. If no candidate exists, the search takes "\\"
    /// for "/" and ignores case, because scenes made on other systems rely on that. Throws LoadError if there is
    /// none.
    std::filesystem::path find(const XmlElement& element, const char* attribute) const;
    /// Returns the path of a file or folder, searched in the same way; empty: not found. Throws LoadError for
    /// an invalid name and for a scene in memory.
    std::optional<std::filesystem::path> find_optional(const XmlElement& element, const char* attribute) const;

    /// Adds the folder that a <path> names. Throws LoadError if there is none.
    void add_folder(const XmlElement& path);

private:
    std::vector<std::filesystem::path> candidates_for(const XmlElement& element, const char* attribute) const;
    std::filesystem::path find_existing(const XmlElement& element, const char* attribute) const;

    const XmlDocument* scene_;
    std::vector<std::filesystem::path> folders_;
};

/// Jobs that read the files named by a scene. They run in parallel once the XML is read.
class FileJobs {
public:
    /// Reads a file and returns what was ignored or damaged. Polls `keep_reading`, and throws soon after it
    /// returns false.
    using Read = std::function<FileReport(const std::function<bool()>& keep_reading)>;

    /// Adds a job, which runs once on any thread. `where` is the parameter whose value is the file name;
    /// messages point at it. `consequence` says what is used if the job throws, such as "grey is used instead".
    void add(const XmlElement& where, std::string consequence, Read read);

    /// Runs all jobs, and notes what was ignored; damage and failed jobs are error notes. Throws OutOfMemory, and
    /// std::runtime_error if loading is given up.
    void run(const ParallelFor& parallel_for, std::vector<LoadNote>& notes, LoadProgress& progress) const;

private:
    struct Job {
        XmlElement where;
        std::string consequence;
        Read read;
    };
    std::vector<Job> jobs_;
};

/// Channel of an image file that a texture uses, which becomes grey: the parameter `channel` of Mitsuba 0.6.
enum class BitmapChannel { all, red, green, blue, alpha };

/// State shared by the plugin readers while one scene is loaded.
struct LoadContext {
    SceneDescription scene;
    std::vector<LoadNote> notes;
    FileJobs jobs;

    bool old_syntax = false; ///< Mitsuba 0.x, where some defaults differ
    FileSearch files;

    /// A shape with triangles: the list in `scene` that holds it (lists do not move), its index, and its
    /// element.
    struct LoadedShape {
        const std::vector<Shape>* shapes;
        std::size_t index;
        XmlElement element;
    };
    std::vector<LoadedShape> shapes;
    std::deque<MeshListing> meshes; ///< of mesh files, in the order of the scene; jobs fill them in
    std::map<std::string, XmlElement> ids;
    std::set<std::string> referred;        ///< ids that a <ref> names
    std::map<const void*, int> materials;  ///< by XmlElement::key(), index into scene.materials
    std::map<const void*, int> groups;     ///< by XmlElement::key(), index into scene.groups
    std::map<const void*, Material> bsdfs; ///< by XmlElement::key()
    std::map<std::tuple<std::string, bool, BitmapChannel>, std::shared_ptr<Bitmap>>
        bitmaps; ///< by path, whether bytes are sRGB, and channel
    std::map<std::tuple<float, MicrofacetDistribution, float>, std::shared_ptr<const Coating>>
        coatings;  ///< by eta, distribution and alpha; precomputing one is slow
    int depth = 0; ///< number of nested plugins being read; detects circular references

    /// Returns the element that a <ref> names, or any other element itself. Throws LoadError for an unknown id.
    XmlElement resolve(const XmlElement& element) const;
    /// Returns the element whose id is this element's attribute "id". Throws LoadError.
    XmlElement resolve_id(const XmlElement& element) const;

    /// Takes the nested plugins with that tag, including referenced ones.
    std::vector<XmlElement> take_nested(Properties& properties, std::string_view tag) const;
    /// Takes the first nested plugin with that tag, and notes that others are not used. Empty: there is none.
    std::optional<XmlElement> take_one_nested(Properties& properties, std::string_view tag) const;

    /// Takes the parameter "filename" and finds its file. If the file is missing, returns nothing and adds an
    /// error note that ends in `consequence`, such as "grey is used instead". Throws LoadError if the parameter is
    /// missing.
    struct File {
        XmlElement parameter;
        std::filesystem::path path;
    };
    std::optional<File> take_file(Properties& properties, std::string_view consequence);
};

/// Counts one level of nested plugins while it lives. The constructor throws LoadError at a depth that only
/// circular references reach.
class NestingGuard {
public:
    NestingGuard(LoadContext& context, const XmlElement& element);
    ~NestingGuard() { --context_.depth; }
    NestingGuard(const NestingGuard&) = delete;
    NestingGuard& operator=(const NestingGuard&) = delete;

private:
    LoadContext& context_;
};

/// Walks through a scene once, in document order, and
/// - replaces $name in attributes by the value in `given`, or else by the value of the latest <default> before;
/// - attaches the files of <include>: they see the variables defined before them, and theirs are visible after
///   them;
/// - adds the folders of <path> to `files`;
/// - replaces files of spectra by their samples.
/// Throws LoadError for an unknown name, a missing file, or a circle of includes. Notes the variables in
/// `given` that the scene does not use.
void expand_scene(XmlDocument& document, const SceneVariables& given, FileSearch& files,
                  std::vector<LoadNote>& notes);

/// Replaces the file of a <spectrum filename="..."> by its samples, as an attribute `value`. Replaces the file of
/// a <string name="filename"> in a <spectrum type="irregular"> by parameters `wavelengths` and `values`. Each line
/// of such a file (.spd) is a wavelength in nm and a value; "#" begins a comment. Other elements are left as they
/// are. A file that is missing or cannot be read has an error note, and the element keeps its file name.
void expand_spectrum_file(const XmlElement& element, pugi::xml_node node, const FileSearch& files,
                          std::vector<LoadNote>& notes);

} // namespace tessera
