#include "ui/state/reference_making.h"

#include "render/io/memory.h"
#include "render/load/mitsuba_xml.h"
#include "render/run/reference_render.h"
#include "render/scene/camera.h"
#include "ui/state/file_names.h"
#include "ui/state/viewer_state.h"

#include <cmath>
#include <system_error>

#include <fmt/core.h>

namespace tessera {

std::filesystem::path default_reference_file(const ViewerState& state) {
    std::string name = scene_name(state.scene_source);
    const Camera camera = state.camera.camera();
    if (state.scene && !(camera == state.scene->camera())) {
        const std::string text = camera_json(camera);
        name += fmt::format("-view-{:08x}", checksum(std::as_bytes(std::span(text.data(), text.size()))));
    }
    std::error_code ignored; // a current folder that is gone shows when the file is to be written
    return reference_file(std::filesystem::current_path(ignored), name, state.request_size(),
                          state.active().settings.render.max_depth);
}

std::filesystem::path wanted_reference_file(const ViewerState& state) {
    std::string typed = state.reference_making.file.data();
    if (typed.empty())
        return default_reference_file(state);
    if (!has_extension(typed, ".exr"))
        typed += ".exr";
    return typed_file(typed);
}

std::optional<double> estimated_seconds(const ViewerState& state) {
    const Snapshot* best = nullptr;
    for (const PaneState& pane : state.panes) {
        const Snapshot* s = pane.snapshot.get();
        if (!s || s->coarse() || s->spp == 0)
            continue;
        if (!best || s->settings.method == state.reference_making.method)
            best = s;
    }
    if (!best)
        return std::nullopt;
    return best->seconds / best->spp * state.reference_making.spp;
}

std::string duration_text(double seconds) {
    const auto minutes = static_cast<long>(std::lround(seconds / 60));
    if (seconds < 90)
        return fmt::format("{:.0f} s", seconds);
    return minutes < 60 ? fmt::format("{} min", minutes) : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

} // namespace tessera
