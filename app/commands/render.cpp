#include "render/run/render.h"

#include "app/cli/picture_layers.h"
#include "app/cli/render_stats.h"
#include "app/cli/scene_source.h"
#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "render/estimator/settings_table.h"
#include "render/io/json_text.h"

#include <algorithm>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

/// What is asked for, with everything left open filled in from the scene.
struct Plan {
    RenderSettings settings;
    glm::ivec2 size;
    int spp; ///< 0: by time
    ReconstructionLayers layers;
};

Plan make_plan(const RenderOptions& options, const Scene& scene) {
    Plan plan{options.settings, options.size.value_or(scene.size()), 0, options.layers};
    plan.settings.max_depth = options.max_depth.value_or(std::min(scene.max_depth(), most_edges));
    plan.spp = options.spp.value_or(options.time ? 0 : usual_spp);
    if (plan.layers.norms.empty())
        plan.layers.norms = {has_gradients(plan.settings.method) ? Norm::weighted : Norm::none};
    return plan;
}

/// Share of the work done, by whichever limit is nearer.
double share_done(const RenderOptions& options, const Plan& plan, const Render& render) {
    double done = plan.spp > 0 ? static_cast<double>(render.spp()) / plan.spp : 0;
    if (options.time)
        done = std::max(done,
                        (options.clock == Clock::cpu ? render.cpu_seconds() : render.seconds()) / *options.time);
    return done;
}

void render_passes(const RenderOptions& options, const Plan& plan, Render& render, ThreadPool& pool) {
    const InterruptGuard guard;
    Progress progress(fmt::format("{} {}x{}", short_name(plan.settings.method), plan.size.x, plan.size.y));
    double done = 0;
    do {
        render.pass(pool);
        done = share_done(options, plan, render);
        const std::string target = plan.spp > 0 ? fmt::format(" of {}", plan.spp) : "";
        progress.update(done, render.seconds(), fmt::format("{}{} spp", render.spp(), target));
    } while (done < 1 && !interrupted());
}

} // namespace

int run_render(const RenderOptions& options) {
    check(options.settings);
    check_writable(options.output);
    check_picture_name(options.output, options.layers);
    if (!options.stats.empty())
        check_writable(options.stats);
    ThreadPool pool(options.threads);
    const OpenedScene opened = open_scene(options.scene, pool);
    for (const std::string& note : group_notes(opened.notes))
        fmt::print(stderr, "note: {}\n", note);

    const Plan plan = make_plan(options, *opened.scene);
    Render render(opened.scene, opened.scene->camera(), plan.size, plan.settings);
    render_passes(options, plan, render, pool);
    warn_of_refused(options.scene, render);

    std::vector<ReconstructionStats> recon;
    const ReuseMaps maps = options.layers.buffers ? render.reuse_maps() : ReuseMaps{};
    ExrFile file = picture_layers(render.take_images(), maps, plan.layers, pool, recon);
    const nlohmann::json settings =
        settings_json(options.scene, plan.settings, plan.size, render.spp(), options.layers.settings.alpha);
    file.attributes["tessera:version"] = TESSERA_VERSION;
    file.attributes["tessera:settings"] = to_text(settings);
    write_picture(options.output, file);
    if (!options.stats.empty()) {
        nlohmann::json stats = stats_json(settings, opened, render, pool.size(), recon, interrupted());
        stats["first_refused"] = refused_json(options.scene, render);
        write_text(options.stats, to_text(stats, 2) + "\n");
    }
    fmt::print(stderr, "{}: {} spp in {:.2f} s ({:.2f} CPU s)\n", options.output.string(), render.spp(),
               render.seconds(), render.cpu_seconds());
    return exit_ok;
}

} // namespace tessera
