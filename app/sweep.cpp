#include "app/sweep.h"

#include "app/exit_codes.h"
#include "app/interrupt.h"
#include "app/load_notes.h"
#include "app/output_file.h"
#include "app/progress.h"
#include "app/reference_pair.h"
#include "app/sweep_report.h"
#include "recon/metrics.h"
#include "render/session/render.h"

#include <algorithm>
#include <chrono>
#include <map>

#include <fmt/core.h>

namespace tessera {

namespace {

/// A scene to render, and the references it has for every depth asked for.
struct SweepScene {
    SceneSource source;
    std::string name;
    std::map<int, ReferencePair> references;
};

/// The folder's for "kitchen/scene.xml" and "kitchen/scene_v3.xml", else the file's.
std::string scene_name(const std::filesystem::path& file) {
    const std::string stem = file.stem().string();
    const std::string folder =
        std::filesystem::absolute(file).lexically_normal().parent_path().filename().string();
    return stem.rfind("scene", 0) == 0 && !folder.empty() ? folder : stem;
}

RgbImage mean_of(const ReferencePair& pair) {
    RgbImage image = pair[0];
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] = 0.5f * (pair[0].data()[i] + pair[1].data()[i]);
    return image;
}

class Sweep {
public:
    /// Looks at all that was given. Throws BadInput.
    explicit Sweep(const SweepOptions& options) : options_(options), pool_(options.threads) {
        points_ = sweep_points(options.settings, options.methods, options.variations);
        for (const SweepPoint& point : points_)
            check(point.settings);
        for (std::uint64_t seed : reference_seeds)
            if (seed - options.settings.seed < static_cast<std::uint64_t>(options.seeds))
                throw BadInput(fmt::format("seed {} is a reference's: errors to it would be too small", seed));
        for (const std::filesystem::path& file : options.scenes)
            scenes_.push_back(scene_of(file));
        check_names();
        for (const SweepScene& scene : scenes_)
            for (const auto& [depth, pair] : scene.references)
                if (!pair.is_complete())
                    pair.check_writable();
        make_folder(options.output);
        check_writable(options.output / "sweep.csv");
    }

    void run() {
        const InterruptGuard guard;
        for (SweepScene& scene : scenes_)
            if (!interrupted())
                run_scene(scene);
        write();
    }

private:
    SweepScene scene_of(const std::filesystem::path& file) const {
        if (!std::filesystem::is_regular_file(file))
            throw BadInput(fmt::format("{}: there is no such scene file", file.string()));
        SweepScene scene{{file, {}, {}}, scene_name(file), {}};
        const ReferenceOptions references{options_.references, options_.size, options_.reference_spp};
        for (const SweepPoint& point : points_) {
            const int depth = point.settings.max_depth;
            if (!scene.references.count(depth))
                scene.references.emplace(depth, ReferencePair(references, scene.name, depth));
        }
        return scene;
    }

    void check_names() const {
        std::map<std::string, std::filesystem::path> files;
        for (const SweepScene& scene : scenes_)
            if (const auto [other, is_new] = files.emplace(scene.name, scene.source.file); !is_new)
                throw BadInput(fmt::format("{} and {} are both named \"{}\"", other->second.string(),
                                           scene.source.file.string(), scene.name));
    }

    void run_scene(SweepScene& scene) {
        const OpenedScene opened = open_scene(scene.source, pool_);
        for (const std::string& note : group_notes(opened.notes))
            fmt::print(stderr, "note: {}\n", note);
        for (auto& [depth, pair] : scene.references)
            if (!pair.make_missing(scene.source, opened.scene, pool_))
                return;

        const std::size_t first = results_.size();
        for (const SweepPoint& point : points_)
            results_.push_back({scene.name, scene.source.file, point, {}});
        // Round by round, so that a machine that others use as well is slow for all points alike.
        const auto start = std::chrono::steady_clock::now();
        Progress progress(scene.name);
        const std::size_t all = points_.size() * static_cast<std::size_t>(options_.seeds);
        for (std::size_t i = 0; i < all && !interrupted(); ++i) {
            SweepResult& result = results_[first + i % points_.size()];
            RenderSettings settings = result.point.settings;
            settings.seed += i / points_.size();
            result.runs.push_back(render(opened.scene, settings, scene.references.at(settings.max_depth)));
            write();
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
            progress.update(static_cast<double>(i + 1) / static_cast<double>(all), seconds.count(),
                            fmt::format("{} of {} renders", i + 1, all));
        }
    }

    SweepRun render(const std::shared_ptr<const Scene>& scene, const RenderSettings& settings,
                    const ReferencePair& references) {
        Render render(scene, scene->camera(), options_.size, settings);
        while (options_.time ? render.cpu_seconds() < *options_.time : render.spp() < options_.spp)
            render.pass(pool_);
        if (const std::string warning = refused_text(render.counters(), settings.seed); !warning.empty())
            fmt::print(stderr, "warning: {}\n", warning);
        const RgbImage image = reconstruct(render.take_images(), options_.reconstruction).image;
        return {settings.seed,
                render.spp(),
                render.cpu_seconds(),
                render.seconds(),
                measure_error(image, mean_of(references)).relative_mse,
                measure_floor_free_error(image, references[0], references[1]),
                render.counters()};
    }

    void write() const { write_sweep(options_, results_, pool_.size(), interrupted()); }

    const SweepOptions& options_;
    ThreadPool pool_;
    std::vector<SweepPoint> points_;
    std::vector<SweepScene> scenes_;
    std::vector<SweepResult> results_;
};

} // namespace

int run_sweep(const SweepOptions& options) {
    Sweep sweep(options);
    sweep.run();
    fmt::print(stderr, "{}: sweep.csv, sweep.json, sweep.md and a chart of each scene\n", options.output.string());
    return exit_ok;
}

} // namespace tessera
