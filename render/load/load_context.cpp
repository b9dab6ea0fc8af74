#include "render/load/load_context.h"

#include "render/io/available_memory.h"
#include "render/io/text.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <optional>
#include <system_error>

namespace tessera {

namespace fs = std::filesystem;

namespace {

/// Returns an existing path that differs at most in case; empty: there is none.
fs::path find_ignoring_case(const fs::path& path) {
    std::error_code error;
    if (fs::exists(path, error))
        return path;
    fs::path found = path.is_absolute() ? path.root_path() : fs::path(".");
    for (const fs::path& part : path.relative_path()) {
        fs::path next = found / part;
        if (!fs::exists(next, error)) {
            next.clear();
            for (const auto& entry : fs::directory_iterator(found, error))
                if (lower_case(entry.path().filename().string()) == lower_case(part.string()))
                    next = next.empty() ? entry.path() : std::min(next, entry.path());
        }
        if (next.empty())
            return {};
        found = next;
    }
    return found;
}

} // namespace

std::vector<fs::path> FileSearch::candidates_for(const XmlElement& element, const char* attribute) const {
    const std::string name = element.required(attribute);
    if (!scene_ || !scene_->folder() || !element.document().folder())
        element.fail("a scene in memory has no files beside it, such as '" + name + "'", attribute);
    if (name.find('\0') != std::string::npos || name.empty())
        element.fail("'" + name + "' is not a file name", attribute);
    std::vector<fs::path> candidates;
    const auto add = [&](const std::string& path) {
        candidates.push_back(*element.document().folder() / path);
        for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder)
            candidates.push_back(*folder / path);
        candidates.push_back(*scene_->folder() / path);
    };
    add(name);
    std::string with_slashes = name;
    std::ranges::replace(with_slashes, '\\', '/');
    if (with_slashes != name)
        add(with_slashes);
    return candidates;
}

std::optional<fs::path> FileSearch::find_optional(const XmlElement& element, const char* attribute) const {
    const std::vector<fs::path> candidates = candidates_for(element, attribute);
    std::error_code error;
    for (const fs::path& candidate : candidates)
        if (fs::exists(candidate, error))
            return candidate;
    for (const fs::path& candidate : candidates)
        if (fs::path found = find_ignoring_case(candidate); !found.empty())
            return found;
    return {};
}

fs::path FileSearch::find_existing(const XmlElement& element, const char* attribute) const {
    if (const std::optional<fs::path> found = find_optional(element, attribute))
        return *found;
    element.fail("there is no file '" + candidates_for(element, attribute).front().string() + "'", attribute);
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

namespace {

std::string joined(const std::vector<std::string>& texts) {
    std::string result;
    for (const std::string& text : texts)
        result += (result.empty() ? "" : ", ") + text;
    return result;
}

} // namespace

void FileJobs::add(const XmlElement& where, std::string consequence, Read read) {
    jobs_.push_back({where, std::move(consequence), std::move(read)});
}

void FileJobs::run(const ParallelFor& parallel_for, std::vector<LoadNote>& notes, LoadProgress& progress) const {
    progress.begin(LoadProgress::Stage::files, static_cast<int>(jobs_.size()));
    struct Outcome {
        FileReport report;
        std::optional<std::string> error;
        std::optional<OutOfMemory> out_of_memory;
    };
    std::vector<Outcome> outcomes(jobs_.size());
    const std::function<bool()> keep_reading = [&] { return !progress.given_up(); };
    parallel_for(static_cast<int>(jobs_.size()), [&](int i) {
        if (progress.given_up())
            return;
        const auto index = static_cast<std::size_t>(i);
        try {
            outcomes[index].report = jobs_[index].read(keep_reading);
        } catch (const OutOfMemory& e) {
            outcomes[index].out_of_memory = e;
        } catch (const std::exception& e) {
            outcomes[index].error = message_of(e);
        }
        progress.step();
    });
    progress.throw_if_cancelled();
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
        const XmlElement& where = jobs_[i].where;
        const std::string file = "'" + where.attribute("value") + "'";
        const std::string failed = "cannot load " + file + ": ";
        if (outcomes[i].out_of_memory)
            where.fail(failed + outcomes[i].out_of_memory->what(), "value");
        if (outcomes[i].error)
            notes.push_back(where.error(failed + *outcomes[i].error, "value").note(jobs_[i].consequence));
        const FileReport& report = outcomes[i].report;
        for (const std::string& note : report.notes)
            notes.push_back({where.position(), file + ": " + note});
        if (!report.ignored.empty())
            notes.push_back({where.position(), file + ": not used: " + joined(report.ignored)});
        for (const std::string& error : report.errors)
            notes.push_back({where.position("value"), file + ": " + error, true});
    }
}

namespace {
constexpr int max_nesting = 64;
}

XmlElement LoadContext::resolve(const XmlElement& element) const {
    return element.tag() == "ref" ? resolve_id(element) : element;
}

XmlElement LoadContext::resolve_id(const XmlElement& element) const {
    const std::string id = element.required("id");
    const auto found = ids.find(id);
    if (found == ids.end())
        element.fail("nothing in the file has the id '" + id + "'", "id");
    return found->second;
}

std::vector<XmlElement> LoadContext::take_nested(Properties& properties, std::string_view tag) const {
    std::vector<XmlElement> result =
        properties.take_all([&](const XmlElement& element) { return resolve(element).tag() == tag; });
    for (XmlElement& element : result)
        element = resolve(element);
    return result;
}

std::optional<XmlElement> LoadContext::take_one_nested(Properties& properties, std::string_view tag) const {
    const std::vector<XmlElement> nested = take_nested(properties, tag);
    if (nested.size() > 1)
        properties.note(nested[1],
                        "only the first <" + std::string(tag) + "> in '" + properties.type() + "' is used");
    return nested.empty() ? std::nullopt : std::optional(nested[0]);
}

std::optional<LoadContext::File> LoadContext::take_file(Properties& properties, std::string_view consequence) {
    const auto parameter = properties.take("filename");
    if (!parameter)
        properties.element().fail("'" + properties.type() + "' needs a 'filename'");
    const std::string name = "'" + parameter->required("value") + "'";
    const std::optional<fs::path> path = files.find_optional(*parameter, "value");
    std::error_code error;
    if (path && fs::is_regular_file(*path, error))
        return File{*parameter, *path};
    const std::string text = path ? name + " is not a file" : "there is no file " + name;
    notes.push_back(parameter->error(text, "value").note(std::string(consequence)));
    return {};
}

NestingGuard::NestingGuard(LoadContext& context, const XmlElement& element) : context_(context) {
    if (context.depth >= max_nesting)
        element.fail("nested too deep: is this a circle of references?");
    ++context.depth;
}

} // namespace tessera
