#include "app/cli/picture_layers.h"
#include "app/cli/render_stats.h"
#include "app/commands/commands.h"
#include "recon/picture/oidn.h"
#include "render/io/json_text.h"
#include "render/run/first_hits.h"
#include "render/scene/camera.h"
#include "ui/state/buffer.h"
#include "ui/viewer/viewer_options.h"

#include <limits>
#include <string>

#include <nlohmann/json.hpp>

namespace tessera {

namespace {

nlohmann::json settings_of(const SavedPicture& picture, Norm norm) {
    const Snapshot& snapshot = *picture.snapshot;
    const glm::ivec2 size(snapshot.images->primal.width(), snapshot.images->primal.height());
    nlohmann::json json =
        settings_json(picture.source, snapshot.settings, size, snapshot.spp, picture.reconstruction);
    json["norm"] = to_string(norm);
    return json;
}

nlohmann::json stats_of(const Snapshot& snapshot, const std::vector<ReconstructionStats>& reconstructions) {
    nlohmann::json json{{"seconds",
                         {{"render", {{"wall", snapshot.seconds}, {"cpu", snapshot.cpu_seconds}}},
                          {"reconstruct", reconstructions_json(reconstructions)}}},
                        {"spp", snapshot.spp}};
    json.update(counters_json(snapshot.counters));
    return json;
}

/// Returns the snapshot's reconstruction if it matches the snapshot's samples and the settings and does not
/// continue an earlier one; else null.
const Reconstruction* finished_reconstruction(const SavedPicture& picture) {
    const Snapshot& s = *picture.snapshot;
    const bool is_current = s.reconstruction && s.reconstruction_spp == s.spp &&
                            s.reconstructed_with == picture.reconstruction && !s.reconstruction->goes_on;
    return is_current && s.reconstruction->image.size() == s.images->primal.size() ? s.reconstruction.get()
                                                                                   : nullptr;
}

/// Makes the layers of `tessera render --buffers`. Appends the cost of the reconstruction to `stats`; the CPU
/// seconds of a reconstruction by the viewer are NaN, as they are not known.
ExrFile render_layers(const SavedPicture& picture, Norm norm, std::vector<ReconstructionStats>& stats) {
    const Snapshot& snapshot = *picture.snapshot;
    const Reconstruction* finished = finished_reconstruction(picture);
    ReconstructionLayers wanted{{}, picture.reconstruction, true};
    if (!finished)
        wanted.norms = {norm};
    ThreadPool pool(1); // only the calling thread
    ExrFile exr = picture_layers(GradientImages(*snapshot.images), snapshot.reuse ? *snapshot.reuse : ReuseMaps{},
                                 wanted, pool, stats);
    if (finished) {
        exr.layers.insert(exr.layers.begin(), {"", finished->image});
        stats.push_back({norm, finished->seconds, std::numeric_limits<double>::quiet_NaN(), finished->iterations,
                         finished->residual, finished->redistributed});
    }
    return exr;
}

/// Adds layers of first hits ("first_hit_...") and of errors of the first layer ("error_...").
void add_companion_layers(ExrFile& exr, const SavedPicture& saved) {
    Snapshot snapshot = *saved.snapshot;
    const RgbImage& image = exr.layers.front().image;
    snapshot.reconstruction = std::make_shared<Reconstruction>(Reconstruction{image});
    Companions companions{saved.reference, nullptr};
    if (saved.scene)
        companions.first_hits = std::make_shared<FirstHits>(
            trace_first_hits(*saved.scene, snapshot.camera, {image.width(), image.height()}, true));
    for (Buffer buffer : all_buffers) {
        const bool is_error = family(buffer) == BufferFamily::error;
        if (!is_error && family(buffer) != BufferFamily::first_hit)
            continue;
        RgbImage scratch;
        const RgbImage& layer = picture(snapshot, buffer, scratch, companions);
        if (layer.empty())
            continue;
        exr.layers.push_back({(is_error ? "error_" : "first_hit_") + std::string(short_name(buffer)), layer});
        if (is_error)
            exr.attributes["tessera:errors_to"] = saved.reference->name;
    }
}

} // namespace

void write_saved_picture(const std::filesystem::path& file, const SavedPicture& shown) {
    SavedPicture picture = shown;
    picture.reconstruction.norm = possible(shown.reconstruction.norm); // as the session shows it
    const Snapshot& snapshot = *picture.snapshot;
    const Norm norm = applied(picture.reconstruction.norm, has_gradients(snapshot.settings.method));
    std::vector<ReconstructionStats> stats;
    ExrFile exr = render_layers(picture, norm, stats);
    add_companion_layers(exr, picture);
    exr.attributes["tessera:version"] = TESSERA_VERSION;
    exr.attributes["tessera:settings"] = to_text(settings_of(picture, norm));
    record_redistributed(exr, stats);
    exr.attributes["tessera:stats"] = to_text(stats_of(snapshot, stats));
    exr.attributes["tessera:camera"] = camera_json(snapshot.camera);
    write_picture(file, exr);
}

} // namespace tessera
