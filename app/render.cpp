#include "app/render.h"

#include "app/exit_codes.h"
#include "app/interrupt.h"
#include "app/load_notes.h"
#include "app/output_file.h"
#include "app/process_usage.h"
#include "app/progress.h"
#include "app/stats.h"
#include "render/load/exr.h"
#include "render/load/png.h"
#include "render/method/settings_table.h"
#include "render/session/render.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <fstream>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

/// What is asked for, with everything left open filled in from the scene.
struct Plan {
    RenderSettings settings;
    glm::ivec2 size;
    int spp; ///< 0: by time
    std::vector<Norm> norms;
};

Plan make_plan(const RenderOptions& options, const Scene& scene) {
    Plan plan{options.settings, options.size.value_or(scene.size()), 0, options.norms};
    plan.settings.max_depth = options.max_depth.value_or(std::min(scene.max_depth(), 64));
    plan.spp = options.spp.value_or(options.time ? 0 : 16);
    if (plan.norms.empty())
        plan.norms = {has_gradients(plan.settings.method) ? Norm::l2 : Norm::none};
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

/// The means of a map, as a layer.
RgbImage gray(const Image<float>& map) {
    RgbImage image(map.width(), map.height());
    std::transform(map.begin(), map.end(), image.begin(), [](float v) { return Rgb(v); });
    return image;
}

/// What is to be written. Nothing is kept that is not: a picture takes more memory here than many a scene.
ExrFile assemble(const RenderOptions& options, Render& render, std::vector<ReconstructionStats>& recon,
                 const std::vector<Norm>& norms, ThreadPool& pool) {
    const ReuseMaps maps = options.buffers ? render.reuse_maps() : ReuseMaps{};
    GradientImages images = render.take_images();
    ExrFile file;
    const ParallelFor parallel_for = [&pool](int count, const std::function<void(int)>& body) {
        pool.parallel_for(count, [&body](int i, int) { body(i); });
    };
    for (Norm norm : norms) {
        const double cpu = process_cpu_seconds();
        Reconstruction r = reconstruct(images, {norm, options.alpha}, parallel_for);
        recon.push_back({norm, r.seconds, process_cpu_seconds() - cpu, r.iterations, r.residual});
        file.layers.push_back({file.layers.empty() ? "" : std::string(to_string(norm)), std::move(r.image)});
    }
    if (!options.buffers)
        return file;
    file.layers.push_back({"primal", std::move(images.primal)});
    if (images.has_gradients()) {
        file.layers.push_back({"dx", std::move(images.dx)});
        file.layers.push_back({"dy", std::move(images.dy)});
    }
    file.layers.push_back({"direct", std::move(images.very_direct)});
    if (!maps.reused.empty()) {
        file.layers.push_back({"reused", gray(maps.reused)});
        file.layers.push_back({"failed", gray(maps.failed)});
    }
    return file;
}

} // namespace

/// Whether the picture is all that is written.
bool writes_png(const RenderOptions& options) {
    std::string extension = options.output.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension != ".png" && extension != ".exr")
        throw BadInput(fmt::format("{}: the name must end in .exr or .png", options.output.string()));
    if (extension == ".png" && (options.buffers || options.norms.size() > 1))
        throw BadInput(
            fmt::format("{}: a PNG file holds one picture; buffers and several reconstructions take EXR",
                        options.output.string()));
    return extension == ".png";
}

int run_render(const RenderOptions& options) {
    check(options.settings);
    check_writable(options.output);
    const bool png = writes_png(options);
    if (!options.stats.empty())
        check_writable(options.stats);
    ThreadPool pool(options.threads);
    const OpenedScene opened = open_scene(options.scene, pool);
    for (const std::string& note : group_notes(opened.notes))
        fmt::print(stderr, "note: {}\n", note);

    const Plan plan = make_plan(options, *opened.scene);
    Render render(opened.scene, opened.scene->camera(), plan.size, plan.settings);
    render_passes(options, plan, render, pool);
    if (const std::string warning = refused_text(render.counters(), plan.settings.seed); !warning.empty())
        fmt::print(stderr, "warning: {}\n", warning);

    std::vector<ReconstructionStats> recon;
    ExrFile file = assemble(options, render, recon, plan.norms, pool);
    const nlohmann::json settings =
        settings_json(options.scene, plan.settings, plan.size, render.spp(), options.alpha);
    file.attributes = {{"tessera:version", TESSERA_VERSION}, {"tessera:settings", settings.dump()}};
    if (png)
        write_png(options.output, file.layers.front().image);
    else
        write_exr(options.output, file);
    if (!options.stats.empty())
        write_text(options.stats,
                   stats_json(settings, opened, render, pool.size(), recon, interrupted()).dump(2) + "\n");
    fmt::print(stderr, "{}: {} spp in {:.2f} s ({:.2f} CPU s)\n", options.output.string(), render.spp(),
               render.seconds(), render.cpu_seconds());
    return exit_ok;
}

} // namespace tessera
