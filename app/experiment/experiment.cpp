#include "app/experiment/experiment.h"

#include "app/cli/opened_scene.h"
#include "app/cli/option_values.h"
#include "app/cli/render_stats.h"
#include "app/cli/terminal.h"
#include "app/experiment/plan.h"
#include "render/io/exr.h"
#include "render/io/files.h"
#include "render/scene/scene.h"
#include "render/settings/settings_table.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

using Setups = std::vector<std::size_t>;

/// Groups setups with equal `part`, in order of their first members.
template <class Part>
std::vector<Setups> grouped(const Setups& setups, Part part) {
    std::vector<Setups> groups;
    for (std::size_t i : setups) {
        const auto found = std::find_if(groups.begin(), groups.end(),
                                        [&](const Setups& group) { return part(group.front()) == part(i); });
        if (found != groups.end())
            found->push_back(i);
        else
            groups.push_back({i});
    }
    return groups;
}

} // namespace

/// A render and the setups that it serves, in order of its reconstructions.
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
    make_folder(options.output / "jobs");
    if (options.keeps_images)
        make_folder(options.output / "images");
    // All processes use the same name here, so this also removes what a killed process left.
    check_writable(plan_file(options.output));
    list_jobs();
    recall();
}

void Experiment::list_jobs() {
    Setups all(setups_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const bool by_samples = options_.effort.unit == Effort::Unit::spp;
    const std::vector<Setups> points =
        by_samples ? grouped(all, [&](std::size_t i) { return setups_[i].values; }) : std::vector<Setups>{all};
    for (std::size_t scene = 0; scene < scenes_.size(); ++scene)
        for (int i = 0; i < options_.seeds; ++i)
            for (const Setups& point : points)
                jobs_.push_back({scene, options_.settings.render.seed + static_cast<std::uint64_t>(i), point});
    files_.resize(jobs_.size());
    is_recalled_.resize(jobs_.size());
    is_collected_.resize(jobs_.size());
}

std::string Experiment::text_of(const Job& job) const {
    std::string text = fmt::format("{}, seed {}", scenes_[job.scene].name(), job.seed);
    if (options_.effort.unit != Effort::Unit::spp)
        return text;
    for (std::size_t i = 0; i < options_.variations.size(); ++i)
        if (const std::string& value = setups_[job.setups.front()].values[i]; !value.empty())
            text += fmt::format(", {} {}", options_.variations[i].variable.id, value);
    return text;
}

const std::shared_ptr<const Scene>& Experiment::open(std::size_t scene) {
    if (!geometry_ || open_scene_ != scene) {
        geometry_.reset(); // frees the old scene first: two may exceed the memory
        const OpenedScene opened = open_scene(scenes_[scene].source(), pool(options_.settings.threads));
        print_notes(opened.notes);
        geometry_ = opened.scene;
        open_scene_ = scene;
    }
    for (const FolderReference* reference : std::as_const(scenes_[scene]).references())
        reference->check_scene(scenes_[scene].source(), *geometry_);
    return geometry_;
}

void Experiment::check_norms() const {
    std::vector<Norm> norms;
    for (const Setup& setup : setups_)
        norms.push_back(setup.settings.reconstruction.norm);
    check_available(norms);
}

bool Experiment::render_reference(std::size_t scene, FolderReference& reference) {
    check_norms(); // fails before a reference that may take hours
    return reference.render(scenes_[scene].source(), open(scene), pool(options_.settings.threads));
}

bool Experiment::run(std::size_t index, Claim& claim, const std::function<void(double)>& report_progress) {
    check_norms();
    const Job& job = jobs_[index];
    std::string found;
    std::vector<SharedRun> runs = runs_of(job, open(job.scene));
    for (const double count = static_cast<double>(runs.size()); !runs.empty();) {
        if (interrupted())
            return false;
        const auto behind = std::min_element(runs.begin(), runs.end(), [](const SharedRun& a, const SharedRun& b) {
            return a.run->done() < b.run->done();
        });
        behind->run->pass();
        if (behind->run->is_done()) {
            found += finish(job, *behind);
            runs.erase(behind);
        }
        double left = 0;
        for (const SharedRun& shared : runs)
            left += std::max(1 - shared.run->done(), 0.0);
        report_progress(1 - left / count);
    }
    for (std::size_t setup : job.setups) // the new file must be complete, also with results of other files
        if (const nlohmann::json known = recalled(job, setup); !known.is_null())
            found += Journal::line(key_of(job.scene, setups_[setup], job.seed), known);
    claim.finish(found);
    return true;
}

/// Groups setups that differ only in reconstruction; they share a render.
std::vector<Experiment::Setups> Experiment::renders_of(const Setups& setups) const {
    return grouped(setups, [&](std::size_t i) {
        PictureSettings settings = setups_[i].settings;
        settings.reconstruction = {};
        return settings;
    });
}

/// Creates the runs of the job's setups whose results are not known.
std::vector<Experiment::SharedRun> Experiment::runs_of(const Job& job,
                                                       const std::shared_ptr<const Scene>& geometry) {
    Setups unknown;
    for (std::size_t i : job.setups)
        if (recalled(job, i).is_null())
            unknown.push_back(i);
    std::vector<SharedRun> runs;
    for (const Setups& group : renders_of(unknown)) {
        std::vector<ReconstructionSettings> reconstructions;
        for (std::size_t i : group)
            reconstructions.push_back(setups_[i].settings.reconstruction);
        PictureSettings settings = setups_[group.front()].settings;
        settings.render.seed = job.seed;
        runs.push_back(
            {group, std::make_unique<MeasuredRun>(
                        Render(geometry, geometry->camera(), settings.size, settings.render), options_.effort,
                        options_.halvings, std::move(reconstructions), options_.measures_artefacts,
                        scenes_[job.scene].reference(settings), pool(settings.threads))});
    }
    return runs;
}

/// Returns the lines of a run for the job's file. Writes pictures first, so that no finished job lacks its
/// picture.
std::string Experiment::finish(const Job& job, const SharedRun& shared) {
    const MeasuredScene& scene = scenes_[job.scene];
    warn_of_invalid_samples(scene.source(), shared.run->render());
    std::string lines;
    for (std::size_t i = 0; i < shared.setups.size(); ++i) {
        const Setup& setup = setups_[shared.setups[i]];
        if (keeps_image(job.seed))
            write_exr(image_file(scene.name(), setup), {{{"", shared.run->images()[i]}}, {}});
        nlohmann::json measurements = nlohmann::json::array();
        for (Measurement m : shared.run->measurements()[i]) {
            m.machine = options_.sharing.machine;
            measurements.push_back(nlohmann::json(to_json(m)));
        }
        lines += Journal::line(key_of(job.scene, setup, job.seed), {{"program", program_identity()},
                                                                    {"triangles", geometry_->triangle_count()},
                                                                    {"measurements", measurements}});
    }
    return lines;
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

ThreadPool& Experiment::pool(int threads) {
    std::unique_ptr<ThreadPool>& pool = pools_[threads];
    if (!pool)
        pool = std::make_unique<ThreadPool>(threads);
    return *pool;
}

} // namespace tessera
