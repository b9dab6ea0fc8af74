#include "render/load/mitsuba_xml.h"

#include "render/io/text.h"
#include "render/load/load_context.h"
#include "render/load/plugins.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <set>
#include <string>
#include <tuple>

namespace tessera {

namespace {

class Stopwatch {
public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void collect_ids(LoadContext& context, const XmlDocument& document) {
    const std::vector<XmlElement> elements = document.elements();
    for (const XmlElement& element : elements) {
        if (element.tag() == "ref")
            context.referred.insert(element.attribute("id"));
        if (!element.has("id") || element.tag() == "ref" || element.tag() == "alias")
            continue;
        const std::string id = element.attribute("id");
        const auto [entry, is_new] = context.ids.emplace(id, element);
        if (!is_new)
            element.fail("the id '" + id + "' is already used by the <" + std::string(entry->second.tag()) +
                             "> at " + entry->second.position().to_string(),
                         "id");
    }
    for (const XmlElement& element : elements)
        if (element.tag() == "alias")
            context.ids.insert_or_assign(element.required("as"), context.resolve_id(element));
}

void read_material(LoadContext& context, const XmlElement& element) {
    material_of(context, element);
}

void read_nothing(LoadContext&, const XmlElement&) {}

// Children of <scene> that may occur many times.
constexpr Plugin<void (*)(LoadContext&, const XmlElement&)> scene_elements[] = {
    {"bsdf", read_material},        {"shape", add_shape},
    {"emitter", add_scene_emitter}, {"default", read_nothing}, // expand_scene() has replaced the variables
    {"alias", read_nothing},                                   // collect_ids() has stored it
    {"texture", read_nothing},                                 // read by the plugin that refers to it
    {"path", read_nothing},                                    // expand_scene() has added the folder
    {"sensor", read_sensor},
};

// Children of <scene> of which only the first is used.
constexpr Plugin<void (*)(LoadContext&, const XmlElement&)> single_elements[] = {
    {"integrator", read_integrator},
};

void read_scene(LoadContext& context, const XmlElement& root) {
    std::set<std::string> read;
    for (const XmlElement& element : root.children()) {
        const std::string tag(element.tag());
        if (const auto* single = find_plugin(single_elements, tag)) {
            if (read.insert(tag).second)
                single->read(context, element);
            else
                context.notes.push_back({element.position(), "only the first " + tag + " is used"});
        } else if (const auto* known = find_plugin(scene_elements, tag)) {
            known->read(context, element);
        } else {
            context.notes.push_back({element.position(), "<" + tag + "> is not known and not used"});
        }
    }
    if (context.scene.sensors.empty())
        context.notes.push_back(
            {root.position(), "the scene has no sensor: a camera at the origin looks along +z"});
}

bool has_old_syntax(const XmlElement& root, std::vector<LoadNote>& notes) {
    if (!root.has("version")) {
        notes.push_back({root.position(), "the scene names no version; Mitsuba 3's defaults are used"});
        return false;
    }
    const std::string version = root.attribute("version");
    const auto major = parse_number(version.substr(0, version.find('.')));
    if (!major || *major < 0)
        root.fail("'" + version + "' is not a version", "version");
    if (*major >= 4)
        notes.push_back(
            {root.position("version"), "the version " + version + " is newer than those known (0.x to 3.x)"});
    return *major < 2;
}

/// Sorts notes by document, line and column, and drops duplicates, which occur when an element is read several
/// times. Notes of an included file follow those of the including file.
void order_notes(std::vector<LoadNote>& notes, const std::vector<const XmlDocument*>& documents) {
    const auto number_of = [&](const std::string& file) {
        const auto has_name = [&](const XmlDocument* document) { return document->name() == file; };
        return std::find_if(documents.begin(), documents.end(), has_name) - documents.begin();
    };
    const auto key = [&](const LoadNote& n) {
        return std::tuple(number_of(n.where.file), n.where.line, n.where.column, std::string_view(n.text));
    };
    std::stable_sort(notes.begin(), notes.end(),
                     [&](const LoadNote& a, const LoadNote& b) { return key(a) < key(b); });
    notes.erase(std::unique(notes.begin(), notes.end(),
                            [&](const LoadNote& a, const LoadNote& b) { return key(a) == key(b); }),
                notes.end());
}

void note_encodings(const std::vector<const XmlDocument*>& documents, std::vector<LoadNote>& notes) {
    for (const XmlDocument* document : documents)
        if (document->was_latin1())
            notes.push_back({{document->name(), 0, 0}, "the file is not UTF-8; it is read as Latin-1"});
}

/// Throws LoadError for the first error note.
void throw_first_error(const std::vector<LoadNote>& notes, const std::vector<const XmlDocument*>& documents) {
    const auto error = std::ranges::find_if(notes, &LoadNote::is_error);
    if (error == notes.end())
        return;
    const auto document = std::ranges::find(documents, error->where.file, &XmlDocument::name);
    throw LoadError(error->where, error->text,
                    document == documents.end() ? "" : (*document)->source_line(error->where.line));
}

LoadedScene load(std::string text, const std::string& name, std::optional<std::filesystem::path> folder,
                 const SceneVariables& variables, const ParallelFor& parallel_for, LoadProgress* reported,
                 bool strict) {
    const Stopwatch parsing;
    LoadProgress unobserved;
    LoadProgress& progress = reported ? *reported : unobserved;
    progress.begin(LoadProgress::Stage::xml);
    LoadContext context;
    XmlDocument document(std::move(text), name, std::move(folder));
    context.files = FileSearch(&document);
    expand_scene(document, variables, context.files, context.notes);
    note_encodings(document.documents(), context.notes);
    const XmlElement root = document.root();
    if (root.tag() != "scene")
        root.fail("a scene file begins with <scene>, not with <" + std::string(root.tag()) + ">");
    context.old_syntax = has_old_syntax(root, context.notes);
    collect_ids(context, document);
    read_scene(context, root);

    LoadedScene result;
    result.parse_seconds = parsing.seconds();
    const Stopwatch reading;
    context.jobs.run(parallel_for, context.notes, progress);
    result.file_seconds = reading.seconds();
    note_missing_attributes(context);
    order_notes(context.notes, document.documents());
    if (strict)
        throw_first_error(context.notes, document.documents());
    result.meshes.assign(context.meshes.begin(), context.meshes.end());
    result.description = std::move(context.scene);
    result.notes = std::move(context.notes);
    return result;
}

} // namespace

LoadedScene load_mitsuba_xml(const std::filesystem::path& file, const SceneVariables& variables,
                             const ParallelFor& parallel_for, LoadProgress* progress, bool strict) {
    return load(read_text(file), file.string(), file.parent_path(), variables, parallel_for, progress, strict);
}

LoadedScene parse_mitsuba_xml(std::string_view xml, const std::string& name, const SceneVariables& variables,
                              const ParallelFor& parallel_for, LoadProgress* progress, bool strict) {
    return load(std::string(xml), name, {}, variables, parallel_for, progress, strict);
}

} // namespace tessera
