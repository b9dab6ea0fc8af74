#include "render/run/render.h"

#include "app/cli/opened_scene.h"
#include "app/cli/option_values.h"
#include "app/cli/picture_layers.h"
#include "app/cli/picture_names.h"
#include "app/cli/pixel_format.h"
#include "app/cli/render_stats.h"
#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/io/json_text.h"
#include "render/io/text.h"
#include "render/scene/scene.h"
#include "render/settings/settings_table.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

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

ResolvedRender resolve(const RenderOptions& options, const Scene& scene, const Camera& camera) {
    const glm::ivec2 film = camera.crop.empty() ? scene.size() : camera.crop.film;
    ResolvedRender wanted{options.settings, camera.crop.size_on(options.size.value_or(film)), 0, options.layers};
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

/// Renders and writes one picture.
/// @param outputs  options with the files of this picture
int render_picture(const RenderOptions& outputs, const SceneSource& source, const OpenedScene& opened,
                   const Camera& camera, ThreadPool& pool) {
    const ResolvedRender wanted = resolve(outputs, *opened.scene, camera);
    ask_for_picture(wanted, pool.size());
    Render render(opened.scene, camera, wanted.size, wanted.settings);
    with_memory_for("the render", [&] { render_passes(outputs, wanted, render, pool); });
    warn_of_invalid_samples(source, render);

    const PixelFormat format = outputs.format.value_or(opened.scene->description().format);
    const Image<float> coverage = has_alpha(format) ? render.coverage() : Image<float>();
    std::vector<ReconstructionStats> recon;
    std::string failure;
    ExrFile file = layers_of(render, wanted, extension_of(outputs.output) == ".exr", pool, recon, failure);
    const nlohmann::json settings =
        settings_json(source, wanted.settings, wanted.size, render.spp(), outputs.layers.settings);
    file.attributes["tessera:version"] = TESSERA_VERSION;
    file.attributes["tessera:settings"] = to_text(settings);
    record_redistributed(file, recon);
    set_pixel_format(file, format, coverage);
    write_picture(outputs.output, file);
    const bool is_finite = warn_of_bad_pixels(file);
    if (!outputs.stats.empty()) {
        nlohmann::json stats = stats_json(settings, opened, render, pool.size(), recon, interrupted());
        stats["first_refused"] = invalid_samples_json(source, render);
        write_text(outputs.stats, to_text(stats, 2) + "\n");
    }
    fmt::print(stderr, "{}: {} spp in {:.2f} s ({:.2f} CPU s)\n", outputs.output.string(), render.spp(),
               render.seconds(), render.cpu_seconds());
    print_redistributed(outputs.output, recon);
    if (!failure.empty())
        throw OutOfMemory(
            fmt::format("{}: {}; the picture is not reconstructed", outputs.output.string(), failure));
    return is_finite ? exit_ok : exit_failure;
}

/// Does `work` and returns its ExitCode. With `goes_on`, prints an error and returns exit_failure instead of
/// throwing it.
template <class Work>
int attempt(bool goes_on, const Work& work) {
    if (!goes_on)
        return work();
    try {
        return work();
    } catch (const std::exception& error) {
        fmt::print(stderr, "tessera: {}\n", message_of(error));
        return exit_failure;
    }
}

/// Renders the pictures of one scene.
/// @param frames  a camera for each picture; empty: one picture from the scene's camera
int render_scene(const RenderOptions& options, const SceneSource& source, const std::vector<Camera>& frames,
                 bool goes_on, ThreadPool& pool) {
    check_outputs({{"-o", options.output}, {"--stats", options.stats}},
                  {{"the scene", source.file}, {"--camera", source.camera}, {"--cameras", options.cameras}});
    check_writable(options.output);
    check_picture_name(options.output, options.layers);
    if (!options.stats.empty())
        check_writable(options.stats);
    const OpenedScene opened = open_scene(source, pool);
    print_notes(opened.notes);
    if (frames.empty())
        return render_picture(options, source, opened, opened.scene->camera(), pool);
    int result = exit_ok;
    for (std::size_t i = 0; i < frames.size() && (i == 0 || !interrupted()); ++i) {
        RenderOptions frame = options;
        frame.output = frame_name(options.output, static_cast<int>(i));
        if (!options.stats.empty())
            frame.stats = frame_name(options.stats, static_cast<int>(i));
        Camera camera = frames[i];
        if (source.crop) // --crop replaces the windows of cameras, too
            camera.crop = {};
        camera = with_film_of(camera, opened.scene->camera());
        result = std::max(result,
                          attempt(goes_on, [&] { return render_picture(frame, source, opened, camera, pool); }));
    }
    return result;
}

} // namespace

int run_render(const RenderOptions& options, const std::vector<SceneSource>& scenes) {
    check(options.settings);
    check_available(options.layers.norms);
    if (options.format && options.layers.buffers)
        check_has_rgb(*options.format);
    std::vector<Camera> frames;
    if (!options.cameras.empty())
        frames = read_camera_path(options.cameras);
    std::vector<std::string> names;
    for (const SceneSource& source : scenes)
        names.push_back(scene_name(source));
    const std::vector<std::filesystem::path> outputs = scene_outputs(options.output, names),
                                             stats = scene_outputs(options.stats, names);
    ThreadPool pool(options.threads);
    const bool goes_on = scenes.size() > 1 || frames.size() > 1;
    int result = exit_ok;
    for (std::size_t i = 0; i < scenes.size() && (i == 0 || !interrupted()); ++i) {
        RenderOptions of_scene = options;
        of_scene.output = outputs[i];
        of_scene.stats = stats[i];
        result = std::max(
            result, attempt(goes_on, [&] { return render_scene(of_scene, scenes[i], frames, goes_on, pool); }));
    }
    return result;
}

} // namespace tessera
