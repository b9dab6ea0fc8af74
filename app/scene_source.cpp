#include "app/scene_source.h"

#include "app/exit_codes.h"
#include "app/process_usage.h"
#include "app/progress.h"
#include "embedded/cornell_box_xml.h"
#include "render/load/camera_file.h"
#include "render/trace/build_monitor.h"

#include <atomic>
#include <optional>
#include <string_view>

#include <fmt/core.h>

namespace tessera {

namespace {
constexpr int per_cent = 100; // steps of the BVH's progress
} // namespace

void check_scene_file(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file))
        throw BadInput(fmt::format("{}: there is no such scene file", file.string()));
}

OpenedScene open_scene(const SceneSource& source, ThreadPool& pool, LoadProgress* progress) {
    const ParallelFor parallel_for = pool.loops();
    const double cpu_at_start = process_cpu_seconds();
    std::optional<Camera> camera;
    if (!source.camera.empty())
        camera = read_camera(source.camera); // first: it is read in no time, and may be broken
    LoadedScene loaded =
        source.file.empty()
            ? parse_mitsuba_xml(cornell_box_xml, "cornell-box.xml", source.variables, parallel_for, progress)
            : load_mitsuba_xml(source.file, source.variables, parallel_for, progress);
    loaded.description.camera = camera.value_or(loaded.description.camera);
    OpenedScene opened;
    opened.notes = std::move(loaded.notes);
    opened.parse_seconds = loaded.parse_seconds;
    opened.file_seconds = loaded.file_seconds;
    const double cpu_after_load = process_cpu_seconds();
    opened.load_cpu_seconds = cpu_after_load - cpu_at_start;
    LoadProgress unwatched;
    LoadProgress& watched = progress ? *progress : unwatched;
    watched.begin(LoadProgress::Stage::bvh, per_cent);
    std::atomic<int> done = 0;
    const BuildMonitor monitor([&](double share) {
        for (int known = done; known < static_cast<int>(share * per_cent);)
            if (done.compare_exchange_weak(known, known + 1))
                watched.step();
        return !watched.given_up();
    });
    opened.scene = std::make_shared<const Scene>(std::move(loaded.description));
    opened.bvh_seconds = opened.scene->bvh_seconds();
    opened.bvh_cpu_seconds = process_cpu_seconds() - cpu_after_load;
    return opened;
}

OpenedScene open_scene(const SceneSource& source, ThreadPool& pool) {
    LoadBar bar;
    return open_scene(source, pool, &bar.progress());
}

} // namespace tessera
