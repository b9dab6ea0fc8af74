#include "app/saved_picture.h"

#include "app/reconstruction_layers.h"
#include "app/stats.h"
#include "render/load/camera_file.h"
#include "render/load/json_text.h"

#include <nlohmann/json.hpp>

namespace tessera {

namespace {

nlohmann::json settings_of(const SavedPicture& picture, Norm norm) {
    const Snapshot& snapshot = *picture.snapshot;
    const glm::ivec2 size(snapshot.images->primal.width(), snapshot.images->primal.height());
    nlohmann::json json = settings_json({picture.scene_file, {}, {}}, snapshot.settings, size, snapshot.spp,
                                        picture.reconstruction.alpha);
    json["norm"] = to_string(norm);
    json["joint_colour"] = picture.reconstruction.joint_colour;
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

} // namespace

void write_saved_picture(const std::filesystem::path& file, const SavedPicture& picture) {
    const Snapshot& snapshot = *picture.snapshot;
    const ReconstructionSettings& reconstruction = picture.reconstruction;
    const Norm norm = has_gradients(snapshot.settings.method) ? reconstruction.norm : Norm::none;
    ThreadPool pool(1); // no thread but this one
    std::vector<ReconstructionStats> stats;
    ExrFile exr = picture_layers(*snapshot.images, snapshot.reuse ? *snapshot.reuse : ReuseMaps{},
                                 {{norm}, reconstruction.alpha, !reconstruction.joint_colour, true}, pool, stats);
    exr.attributes["tessera:version"] = TESSERA_VERSION;
    exr.attributes["tessera:settings"] = to_text(settings_of(picture, norm));
    exr.attributes["tessera:stats"] = to_text(stats_of(snapshot, stats));
    exr.attributes["tessera:camera"] = camera_json(snapshot.camera);
    write_picture(file, exr);
}

} // namespace tessera
