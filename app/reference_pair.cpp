#include "app/reference_pair.h"

#include "app/exit_codes.h"
#include "app/interrupt.h"
#include "app/output_file.h"
#include "app/progress.h"
#include "app/stats.h"
#include "recon/reconstruct.h"
#include "render/load/exr.h"
#include "render/session/render.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

RgbImage read_reference(const std::filesystem::path& path, glm::ivec2 size) {
    const ExrFile file = read_exr(path);
    const RgbImage& image = require_layer(file, "", path);
    if (image.width() != size.x || image.height() != size.y)
        throw BadInput(fmt::format("{} is {}x{}, but {}x{} is to be rendered", path.string(), image.width(),
                                   image.height(), size.x, size.y));
    return image;
}

} // namespace

ReferencePair::ReferencePair(const ReferenceOptions& options, const std::string& scene_name, int max_depth)
    : options_(options), max_depth_(max_depth) {
    for (std::size_t i = 0; i < 2; ++i) {
        paths_[i] = options.folder / fmt::format("{}-{}x{}-d{}-{}.exr", scene_name, options.size.x, options.size.y,
                                                 max_depth, i + 1);
        if (std::filesystem::exists(paths_[i]))
            images_[i] = read_reference(paths_[i], options.size);
    }
}

void ReferencePair::check_writable() const {
    make_folder(options_.folder);
    for (std::size_t i = 0; i < 2; ++i)
        if (!images_[i])
            tessera::check_writable(paths_[i]);
}

bool ReferencePair::make_missing(const SceneSource& source, const std::shared_ptr<const Scene>& scene,
                                 ThreadPool& pool) {
    for (std::size_t i = 0; i < 2; ++i)
        if (!images_[i] && !make(i, source, scene, pool))
            return false;
    return true;
}

bool ReferencePair::make(std::size_t i, const SceneSource& source, const std::shared_ptr<const Scene>& scene,
                         ThreadPool& pool) {
    RenderSettings settings;
    settings.method = Method::gpr;
    settings.tile = 8;
    settings.max_depth = max_depth_;
    settings.seed = reference_seeds[i];
    fmt::print(stderr, "{} is missing: rendering it\n", paths_[i].string());
    Render render(scene, scene->camera(), options_.size, settings);
    {
        Progress progress(fmt::format("reference {}", i + 1));
        while (render.spp() < options_.spp && !interrupted()) {
            render.pass(pool);
            progress.update(static_cast<double>(render.spp()) / options_.spp, render.seconds(),
                            fmt::format("{} of {} spp", render.spp(), options_.spp));
        }
    }
    if (render.spp() < options_.spp)
        return false;
    const ReconstructionSettings l2{.norm = Norm::l2};
    images_[i] = reconstruct(render.take_images(), l2).image;
    const std::string text = settings_json(source, settings, options_.size, options_.spp, l2.alpha).dump();
    write_exr(paths_[i],
              {{{"", *images_[i]}}, {{"tessera:version", TESSERA_VERSION}, {"tessera:settings", text}}});
    return true;
}

} // namespace tessera
