#include "render/run/render.h"

#include "app/cli/opened_scene.h"
#include "app/cli/option_values.h"
#include "app/cli/picture_layers.h"
#include "app/cli/render_stats.h"
#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/io/json_text.h"
#include "render/scene/scene.h"
#include "render/settings/settings_table.h"

#include <algorithm>
#include <cstdio>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

/// The options of a render, completed from the scene.
struct ResolvedRender {
    RenderSettings settings;
    glm::ivec2 size;
    int spp; ///< 0: limited by time
    ReconstructionLayers layers;
};

/// Basis components have their own solver and no denoiser.
Norm default_norm(const RenderSettings& s) {
    return is_expanded(s) ? Norm::weighted : has_gradients(s.method) ? Norm::guided : Norm::none;
}

ResolvedRender resolve(const RenderOptions& options, const Scene& scene) {
    ResolvedRender wanted{options.settings, options.size.value_or(scene.size()), 0, options.layers};
    wanted.settings.max_depth = options.max_depth.value_or(std::min(scene.max_depth(), most_edges));
    wanted.spp = options.spp.value_or(options.time ? 0 : default_spp);
    if (wanted.layers.norms.empty())
        wanted.layers.norms = {default_norm(wanted.settings)};
    return wanted;
}

/// Returns the finished fraction, by the limit that is nearer.
double fraction_done(const RenderOptions& options, const ResolvedRender& wanted, const Render& render) {
    double done = wanted.spp > 0 ? static_cast<double>(render.spp()) / wanted.spp : 0;
    if (options.time)
        done = std::max(done, (options.clock == ClockChoice::cpu ? render.cpu_seconds() : render.seconds()) /
                                  *options.time);
    return done;
}

void render_passes(const RenderOptions& options, const ResolvedRender& wanted, Render& render, ThreadPool& pool) {
    const InterruptGuard guard;
    Progress progress(fmt::format("{} {}x{}", short_name(wanted.settings.method), wanted.size.x, wanted.size.y));
    double done = 0;
    do {
        render.pass(pool);
        done = fraction_done(options, wanted, render);
        const std::string target = wanted.spp > 0 ? fmt::format(" of {}", wanted.spp) : "";
        progress.update(done, render.seconds(), fmt::format("{}{} spp", render.spp(), target));
    } while (done < 1 && !interrupted());
}

/// Reports the first layer on stderr with a pixel that is not finite. Returns true if there is none.
bool warn_of_bad_pixels(const ExrFile& file) {
    for (const ExrLayer& layer : file.layers) {
        const std::string bad = text_of_bad_pixel(layer.image);
        if (bad.empty())
            continue;
        fmt::print(stderr, "warning: layer \"{}\" is not finite: {}; its radiance exceeds the range of floats\n",
                   layer.name, bad);
        return false;
    }
    return true;
}

/// Checks size and memory before the first pass, so that no render is lost for lack of them.
void ask_for_picture(const ResolvedRender& wanted, int threads) {
    const RenderSettings& settings = wanted.settings;
    check_image_size(wanted.size.x, wanted.size.y);
    require_memory(std::max(Render::bytes(wanted.size, settings, threads),
                            bytes_for_layers(wanted.size, settings, wanted.layers, threads)),
                   fmt::format("{}x{} pixels of {}", wanted.size.x, wanted.size.y, short_name(settings.method)));
}

/// Returns the layers of the picture. If the reconstruction does not fit into memory, returns the layers to keep
/// and sets `failure` to the reason.
ExrFile layers_of(Render& render, const ResolvedRender& wanted, bool is_exr, ThreadPool& pool,
                  std::vector<ReconstructionStats>& stats, std::string& failure) {
    const ReuseMaps maps = wanted.layers.buffers ? render.reuse_maps() : ReuseMaps{};
    GradientImages images = render.take_images();
    try {
        return picture_layers(std::move(images), maps, wanted.layers, pool, stats);
    } catch (const OutOfMemory& error) {
        failure = error.what();
        stats.clear();
        return unreconstructed_layers(std::move(images), is_exr);
    }
}

} // namespace

int run_render(const RenderOptions& options) {
    check(options.settings);
    check_available(options.layers.norms);
    check_outputs({{"-o", options.output}, {"--stats", options.stats}},
                  {{"the scene", options.scene.file}, {"--camera", options.scene.camera}});
    check_writable(options.output);
    check_picture_name(options.output, options.layers);
    if (!options.stats.empty())
        check_writable(options.stats);
    ThreadPool pool(options.threads);
    const OpenedScene opened = open_scene(options.scene, pool);
    print_notes(opened.notes);

    const ResolvedRender wanted = resolve(options, *opened.scene);
    ask_for_picture(wanted, pool.size());
    Render render(opened.scene, opened.scene->camera(), wanted.size, wanted.settings);
    with_memory_for("the render", [&] { render_passes(options, wanted, render, pool); });
    warn_of_invalid_samples(options.scene, render);

    std::vector<ReconstructionStats> recon;
    std::string failure;
    ExrFile file = layers_of(render, wanted, extension_of(options.output) == ".exr", pool, recon, failure);
    const nlohmann::json settings =
        settings_json(options.scene, wanted.settings, wanted.size, render.spp(), options.layers.settings);
    file.attributes["tessera:version"] = TESSERA_VERSION;
    file.attributes["tessera:settings"] = to_text(settings);
    record_redistributed(file, recon);
    write_picture(options.output, file);
    const bool is_finite = warn_of_bad_pixels(file);
    if (!options.stats.empty()) {
        nlohmann::json stats = stats_json(settings, opened, render, pool.size(), recon, interrupted());
        stats["first_refused"] = invalid_samples_json(options.scene, render);
        write_text(options.stats, to_text(stats, 2) + "\n");
    }
    fmt::print(stderr, "{}: {} spp in {:.2f} s ({:.2f} CPU s)\n", options.output.string(), render.spp(),
               render.seconds(), render.cpu_seconds());
    print_redistributed(options.output, recon);
    if (!failure.empty())
        throw OutOfMemory(
            fmt::format("{}: {}; the picture is not reconstructed", options.output.string(), failure));
    return is_finite ? exit_ok : exit_failure;
}

} // namespace tessera
