#include "ui/state/reference_making.h"

#include "render/io/memory.h"
#include "render/load/scene_source.h"
#include "render/run/reference_render.h"
#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "ui/state/document.h"
#include "ui/state/file_names.h"

#include <cmath>
#include <system_error>

#include <fmt/core.h>

namespace tessera {

std::filesystem::path default_reference_file(const Document& document) {
    std::string name = scene_name(document.scene_info.source);
    const Camera camera = document.camera.camera();
    if (document.scene && !(camera == document.scene->camera())) {
        const std::string text = camera_json(camera);
        name += fmt::format("-view-{:08x}", checksum(std::as_bytes(std::span(text.data(), text.size()))));
    }
    std::error_code ignored; // a deleted current folder causes an error when the file is written
    return reference_file(std::filesystem::current_path(ignored), name, document.request_size(),
                          document.active().settings.render.max_depth, document.active().settings.render.filter);
}

std::filesystem::path wanted_reference_file(const Document& document) {
    std::string typed = document.reference_making.file.data();
    if (typed.empty())
        return default_reference_file(document);
    if (!has_extension(typed, ".exr"))
        typed += ".exr";
    return typed_file(typed);
}

std::optional<double> estimated_seconds(const Document& document) {
    const Snapshot* best = nullptr;
    for (const PaneState& pane : document.panes) {
        const Snapshot* s = pane.snapshot.get();
        if (!s || s->coarse() || s->spp == 0)
            continue;
        if (!best || s->settings.method == document.reference_making.method)
            best = s;
    }
    if (!best)
        return std::nullopt;
    return best->seconds / best->spp * document.reference_making.spp;
}

std::string duration_text(double seconds) {
    const auto minutes = static_cast<long>(std::lround(seconds / 60));
    if (seconds < 90)
        return fmt::format("{:.0f} s", seconds);
    return minutes < 60 ? fmt::format("{} min", minutes) : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

} // namespace tessera
