#include "app/cli/opened_scene.h"

#include "app/cli/terminal.h"
#include "embedded/cornell_box_xml.h"
#include "render/io/available_memory.h"
#include "render/load/mitsuba_xml.h"
#include "render/run/thread_pool.h"
#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "render/trace/intersector.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/core.h>
#include <fmt/format.h>

namespace tessera {

namespace {

constexpr std::size_t max_listed = 3; // positions listed after the first

std::string place(const FilePosition& where, const FilePosition& first) {
    return where.file == first.file && where.line > 0 ? fmt::format("{}:{}", where.line, where.column)
                                                      : where.to_string();
}

std::string line_of(const std::vector<const LoadNote*>& same) {
    const FilePosition& first = same.front()->where;
    std::string line = first.to_string() + ": " + same.front()->text;
    if (same.size() == 1)
        return line;
    std::vector<std::string> places;
    for (std::size_t i = 1; i < std::min(same.size(), max_listed + 1); ++i)
        places.push_back(place(same[i]->where, first));
    line += fmt::format(" (also at {}", fmt::join(places, ", "));
    const std::size_t unnamed = same.size() - 1 - places.size();
    if (unnamed > 0)
        line += fmt::format(" and {} more place{}", unnamed, unnamed == 1 ? "" : "s");
    return line + ")";
}

constexpr int per_cent = 100; // steps of the BVH's progress

/// Builds the scene, and adds its name to errors.
std::shared_ptr<const Scene> build(SceneDescription description, const std::string& name) {
    try {
        return with_memory_for("its BVH and lights",
                               [&] { return std::make_shared<const Scene>(std::move(description)); });
    } catch (const OutOfMemory& error) {
        throw OutOfMemory(name + ": " + error.what());
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(name + ": " + error.what());
    }
}

/// Chooses the scene's sensor and crop window.
/// @param camera  replaces the sensor's (with_film_of()); empty: the sensor's
void choose_view(SceneDescription& scene, const SceneSource& source, std::optional<Camera> camera,
                 std::vector<LoadNote>& notes) {
    try {
        if (!source.sensor.empty())
            scene.use(scene.sensors.at(find_sensor(scene.sensors, source.sensor)));
        else if (scene.sensors.size() > 1)
            notes.push_back({{source.file.string(), 0, 0},
                             fmt::format("the scene has several sensors, {}: sensor 0 is used (--sensor)",
                                         list_of(scene.sensors))});
    } catch (const std::runtime_error& error) {
        throw BadInput(fmt::format("--sensor {}: {}: {}", source.sensor, to_string(source), error.what()));
    }
    const Camera own = scene.camera;
    const glm::ivec2 film = own.crop.empty() ? scene.size : own.crop.film;
    if (camera)
        scene.camera = with_film_of(*camera, own);
    if (!source.crop) {
        if (const CropWindow& crop = scene.camera.crop; !crop.empty())
            scene.size = crop.size;
        return;
    }
    CropWindow crop = *source.crop;
    if (crop.film == glm::ivec2(0))
        crop.film = film;
    if (!crop.empty() && !crop.is_valid())
        throw BadInput(fmt::format("--crop {}: the window does not lie within the film of {}x{} pixels",
                                   text_of(crop), crop.film.x, crop.film.y));
    scene.size = crop.size_on(crop.film);
    scene.camera.crop = crop.empty() || crop.size == crop.film ? CropWindow{} : crop;
}

} // namespace

Camera with_film_of(Camera camera, const Camera& sensor) {
    if (camera.crop.empty())
        camera.crop = sensor.crop;
    if (camera.filter == PixelFilter())
        camera.filter = sensor.filter;
    return camera;
}

SceneNotes group_notes(const std::vector<LoadNote>& notes) {
    std::map<std::string_view, std::size_t> group_of;
    std::vector<std::vector<const LoadNote*>> groups;
    for (const LoadNote& note : notes) {
        const auto [found, is_new] = group_of.emplace(note.text, groups.size());
        if (is_new)
            groups.emplace_back();
        groups[found->second].push_back(&note);
    }
    SceneNotes lines;
    for (const bool is_error : {true, false})
        for (const auto& group : groups)
            if (group.front()->is_error == is_error)
                lines.push_back({line_of(group), is_error});
    return lines;
}

void print_notes(const std::vector<LoadNote>& notes) {
    for (const SceneNote& note : group_notes(notes))
        fmt::print(stderr, "{}: {}\n", note.is_error ? "error" : "note", note.text);
}

void check_outputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
    const auto is_same = [](const NamedFile& a, const NamedFile& b) {
        std::error_code none;
        if (a.file.empty() || b.file.empty() || is_special(a.file))
            return false;
        return std::filesystem::weakly_canonical(a.file, none) == std::filesystem::weakly_canonical(b.file, none);
    };
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        std::vector<NamedFile> others(outputs.begin() + static_cast<std::ptrdiff_t>(i) + 1, outputs.end());
        others.insert(others.end(), inputs.begin(), inputs.end());
        for (const NamedFile& other : others)
            if (is_same(outputs[i], other))
                throw BadInput(fmt::format("{}: {} and {} are the same file", outputs[i].file.string(),
                                           outputs[i].option, other.option));
    }
}

void check_scene_file(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file))
        throw BadInput(fmt::format("{}: there is no such scene file", file.string()));
}

OpenedScene open_scene(const SceneSource& source, ThreadPool& pool, LoadProgress* progress) {
    const ParallelFor parallel_for = pool.loops();
    const double cpu_at_start = process_cpu_seconds();
    std::optional<Camera> camera;
    if (!source.camera.empty())
        camera = read_camera(source.camera); // first: reading it is fast, and it may be invalid
    LoadedScene loaded = with_memory_for("the scene " + to_string(source), [&] {
        return source.file.empty()
                   ? parse_mitsuba_xml(cornell_box_xml, "cornell-box.xml", source.variables, parallel_for,
                                       progress, source.strict)
                   : load_mitsuba_xml(source.file, source.variables, parallel_for, progress, source.strict);
    });
    choose_view(loaded.description, source, camera, loaded.notes);
    OpenedScene opened;
    opened.notes = std::move(loaded.notes);
    opened.meshes = std::move(loaded.meshes);
    opened.parse_seconds = loaded.parse_seconds;
    opened.file_seconds = loaded.file_seconds;
    const double cpu_after_load = process_cpu_seconds();
    opened.load_cpu_seconds = cpu_after_load - cpu_at_start;
    LoadProgress unused;
    LoadProgress& shown = progress ? *progress : unused;
    shown.begin(LoadProgress::Stage::bvh, per_cent);
    std::atomic<int> done = 0;
    const BuildMonitor monitor([&](double fraction) {
        for (int known = done; known < static_cast<int>(fraction * per_cent);)
            if (done.compare_exchange_weak(known, known + 1))
                shown.step();
        return !shown.given_up();
    });
    opened.scene = build(std::move(loaded.description), to_string(source));
    opened.bvh_seconds = opened.scene->bvh_seconds();
    opened.bvh_cpu_seconds = process_cpu_seconds() - cpu_after_load;
    return opened;
}

OpenedScene open_scene(const SceneSource& source, ThreadPool& pool) {
    LoadBar bar;
    return open_scene(source, pool, &bar.progress());
}

SceneLoader loader_of(const SceneSource& source, int threads) {
    return [source, threads](SceneNotes& notes, LoadProgress& progress) {
        lower_priority(); // its worker threads inherit the priority
        ThreadPool pool(threads);
        const OpenedScene opened = open_scene(source, pool, &progress);
        notes = group_notes(opened.notes);
        return opened.scene;
    };
}

SceneOrigin origin_of(const SceneSource& source, int threads) {
    return {to_string(source),
            {source.file, source.variables, {}, source.strict, source.sensor, source.crop},
            loader_of(source, threads)};
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
        throw BadInput(fmt::format("{}: the folder cannot be made: {}", folder.string(),
                                   error ? error.message() : "a file is in its place"));
}

} // namespace tessera
