#include "app/experiment/experiment.h"

#include "app/cli/opened_scene.h"
#include "app/cli/render_stats.h"
#include "app/cli/terminal.h"
#include "render/io/exr.h"
#include "render/scene/scene.h"
#include "render/settings/settings_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

/// The setups that differ in reconstruction alone, by their indices: they share a render.
std::vector<std::vector<std::size_t>> by_render(const std::vector<Setup>& setups) {
    std::vector<std::vector<std::size_t>> groups;
    const auto render_of = [&](std::size_t i) {
        PictureSettings settings = setups[i].settings;
        settings.reconstruction = {};
        return settings;
    };
    for (std::size_t i = 0; i < setups.size(); ++i) {
        const auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
            return render_of(group.front()) == render_of(i);
        });
        if (found != groups.end())
            found->push_back(i);
        else
            groups.push_back({i});
    }
    return groups;
}

} // namespace

/// A render, and the setups that it serves in the order of its reconstructions.
struct Experiment::SharedRun {
    std::vector<std::size_t> setups;
    std::unique_ptr<MeasuredRun> run;
};

Experiment::Experiment(const ExperimentOptions& options)
    : options_(options), setups_(setups_of(options.settings, options.methods, options.norms, options.variations)) {
    for (const Setup& setup : setups_)
        check(setup.settings.render);
    for (const std::filesystem::path& file : options.scenes)
        scenes_.emplace_back(SceneSource{file, options.variables, {}, true}, setups_, options.references,
                             options.recipe);
    check_names(scenes_);
    for (const MeasuredScene& scene : scenes_) {
        scene.check_seeds(options.settings.render.seed, options.seeds);
        scene.check_writable();
    }
    make_folder(options.output);
    if (options.keeps_images)
        make_folder(options.output / "images");
    check_writable(options.output / "journal.jsonl");
    journal_.emplace(options.output / "journal.jsonl");
    renders_ = static_cast<double>(by_render(setups_).size() * scenes_.size()) * options.seeds;
}

void Experiment::run(const std::function<void()>& report) {
    const InterruptGuard guard;
    start_ = std::chrono::steady_clock::now();
    for (MeasuredScene& scene : scenes_)
        if (!interrupted())
            run_scene(scene, report);
    progress_.reset();
    report();
}

void Experiment::run_scene(MeasuredScene& scene, const std::function<void()>& report) {
    ThreadPool& usual = pool(options_.settings.threads);
    const OpenedScene opened = open_scene(scene.source(), usual);
    print_notes(opened.notes);
    if (!scene.make_references(opened.scene, usual))
        return;
    triangles_ = opened.scene->triangle_count();
    scene_checksums_ = checksums_of(opened.scene->description(), opened.scene->camera());
    progress_.emplace("measuring");
    for (int i = 0; i < options_.seeds && !interrupted(); ++i) {
        run_round(scene, opened.scene, options_.settings.render.seed + static_cast<std::uint64_t>(i));
        report();
    }
}

void Experiment::run_round(const MeasuredScene& scene, const std::shared_ptr<const Scene>& geometry,
                           std::uint64_t seed) {
    std::vector<SharedRun> runs = unfinished_runs(scene, geometry, seed);
    while (!runs.empty() && !interrupted()) {
        const auto behind = std::min_element(runs.begin(), runs.end(), [](const SharedRun& a, const SharedRun& b) {
            return a.run->done() < b.run->done();
        });
        behind->run->pass();
        if (behind->run->is_done()) {
            finish(scene, *behind, seed);
            runs.erase(behind);
        }
        tell(runs, scene.name());
    }
}

std::vector<Experiment::SharedRun> Experiment::unfinished_runs(const MeasuredScene& scene,
                                                               const std::shared_ptr<const Scene>& geometry,
                                                               std::uint64_t seed) {
    std::vector<SharedRun> runs;
    for (const std::vector<std::size_t>& group : by_render(setups_)) {
        SharedRun shared;
        std::vector<ReconstructionSettings> reconstructions;
        for (std::size_t i : group) {
            if (recall(scene, i, seed))
                continue;
            shared.setups.push_back(i);
            reconstructions.push_back(setups_[i].settings.reconstruction);
        }
        if (shared.setups.empty()) {
            --renders_;
            continue;
        }
        PictureSettings settings = setups_[group.front()].settings;
        settings.render.seed = seed;
        shared.run = std::make_unique<MeasuredRun>(
            Render(geometry, geometry->camera(), settings.size, settings.render), options_.effort,
            options_.halvings, std::move(reconstructions), options_.measures_artefacts, scene.reference(settings),
            pool(settings.threads));
        runs.push_back(std::move(shared));
    }
    return runs;
}

/// Records what a run has found. Pictures are written first, so that what the journal knows is complete.
void Experiment::finish(const MeasuredScene& scene, const SharedRun& shared, std::uint64_t seed) {
    warn_of_refused(scene.source(), shared.run->render());
    for (std::size_t i = 0; i < shared.setups.size(); ++i) {
        const Setup& setup = setups_[shared.setups[i]];
        if (keeps_image(seed))
            write_exr(image_file(scene.name(), setup), {{{"", shared.run->images()[i]}}, {}});
        nlohmann::json measurements = nlohmann::json::array();
        for (const Measurement& m : shared.run->measurements()[i])
            measurements.push_back(nlohmann::json(to_json(m)));
        journal_->record(key_of(scene, setup, seed),
                         {{"program", program_identity()}, {"measurements", measurements}});
        add(scene, shared.setups[i], shared.run->measurements()[i]);
    }
    ++finished_;
}

/// Takes measurements from the journal. False: they are not there, or the picture is not, or artefacts were not
/// measured.
bool Experiment::recall(const MeasuredScene& scene, std::size_t setup, std::uint64_t seed) {
    const nlohmann::json known = journal_->find(key_of(scene, setups_[setup], seed));
    if (known.is_null() || (known.at("program") != program_identity() && !options_.takes_any_build) ||
        (keeps_image(seed) && !std::filesystem::exists(image_file(scene.name(), setups_[setup]))))
        return false;
    std::vector<Measurement> measurements;
    for (const nlohmann::json& m : known.at("measurements")) {
        measurements.push_back(measurement_from_json(m));
        if (options_.measures_artefacts && !measurements.back().artefacts)
            return false;
    }
    add(scene, setup, measurements);
    return true;
}

void Experiment::add(const MeasuredScene& scene, std::size_t setup, const std::vector<Measurement>& measurements) {
    for (const Measurement& m : measurements) {
        const std::array place{&scene - scenes_.data(), static_cast<std::ptrdiff_t>(setup),
                               static_cast<std::ptrdiff_t>(-m.halvings)};
        const Result none{scene.name(), scene.source().file, setups_[setup], m.halvings, triangles_, {}};
        results_.try_emplace(place, none).first->second.runs.push_back(m);
    }
}

std::vector<Result> Experiment::results() const {
    std::vector<Result> results;
    for (const auto& [place, result] : results_)
        results.push_back(result);
    return results;
}

bool Experiment::keeps_image(std::uint64_t seed) const {
    return options_.keeps_images && seed == options_.settings.render.seed;
}

std::filesystem::path Experiment::image_file(const std::string& scene, const Setup& setup) const {
    std::string name = fmt::format("{}-{}", scene, name_of(setup));
    for (const std::string& value : setup.values)
        name += "-" + value;
    return options_.output / "images" / (name + ".exr");
}

/// All that the measurements depend on, but for the program.
nlohmann::json Experiment::key_of(const MeasuredScene& scene, const Setup& setup, std::uint64_t seed) const {
    RenderSettings settings = setup.settings.render;
    settings.seed = seed;
    return {{"scene", scene.name()},
            {"scene_checksums", to_string(scene_checksums_)},
            {"settings", settings_json({}, settings, setup.settings.size, 0, setup.settings.reconstruction)},
            {"recon", to_string(setup.settings.reconstruction.norm)},
            {"threads", setup.settings.threads},
            {"effort", to_string(options_.effort)},
            {"halvings", options_.halvings},
            {"reference", checksum_of(scene.reference(setup.settings))},
            {"cpu", cpu_model()}};
}

void Experiment::tell(const std::vector<SharedRun>& runs, const std::string& scene) {
    double done = finished_;
    for (const SharedRun& shared : runs)
        done += std::min(shared.run->done(), 1.0);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
    progress_->update(done / std::max(renders_, 1.0), seconds.count(),
                      fmt::format("{}, {:g} of {:g} renders", scene, finished_, renders_));
}

ThreadPool& Experiment::pool(int threads) {
    std::unique_ptr<ThreadPool>& pool = pools_[threads];
    if (!pool)
        pool = std::make_unique<ThreadPool>(threads);
    return *pool;
}

} // namespace tessera
