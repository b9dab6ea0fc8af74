// The results of an experiment: the files of its jobs, and the measurements in them.
#include "app/cli/terminal.h"
#include "app/experiment/experiment.h"
#include "render/io/files.h"
#include "render/io/json_text.h"
#include "render/io/memory.h"
#include "render/run/picture_identity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

namespace fs = std::filesystem;

std::uint32_t checksum_of(const std::string& text) {
    return checksum(std::as_bytes(std::span(text)));
}

} // namespace

nlohmann::json key_of_run(const ExperimentOptions& options, const std::string& scene, const Setup& setup,
                          std::uint64_t seed) {
    RenderSettings settings = setup.settings.render;
    settings.seed = seed;
    return {{"scene", scene},
            {"settings", settings_json({}, settings, setup.settings.size, 0, setup.settings.reconstruction)},
            {"recon", to_string(setup.settings.reconstruction.norm)},
            {"threads", setup.settings.threads},
            {"effort", to_string(options.effort)},
            {"halvings", options.halvings}};
}

/// Returns the key of a run: all inputs that its measurements depend on, except for the program and the machine.
nlohmann::json Experiment::key_of(std::size_t scene, const Setup& setup, std::uint64_t seed) const {
    nlohmann::json key = key_of_run(options_, scenes_[scene].name(), setup, seed);
    key["scene_file"] = scene_files_[scene];
    key["reference"] = scenes_[scene].reference_for(setup.settings).checksum();
    return key;
}

/// Returns the name of the job's file. Its checksum covers all inputs of the job except for the seed.
std::string Experiment::file_name_of(const Job& job) {
    Setups place = job.setups;
    place.push_back(job.scene);
    std::string& name = point_names_[place];
    if (name.empty()) {
        nlohmann::json all = {options_.measures_artefacts,
                              options_.takes_any_build ? std::string() : program_identity()};
        for (std::size_t i : job.setups)
            all.push_back(key_of(job.scene, setups_[i], 0));
        name = scenes_[job.scene].name();
        if (options_.effort.unit == Effort::Unit::spp)
            for (const std::string& value : setups_[job.setups.front()].values)
                name += value.empty() ? "" : "-" + value;
        name += fmt::format("-{:08x}", checksum_of(to_text(all)));
    }
    return fmt::format("{}-seed{}.jsonl", name, job.seed);
}

fs::path Experiment::file_of(std::size_t index) {
    const Job& job = jobs_[index];
    if (!files_[index].empty())
        return files_[index];
    for (std::size_t i : job.setups)
        if (!scenes_[job.scene].reference_for(setups_[i].settings).look())
            return {};
    return files_[index] = options_.output / "jobs" / file_name_of(job);
}

bool Experiment::is_done(std::size_t job) {
    return is_recalled_[job] != 0 || (!file_of(job).empty() && fs::exists(file_of(job)));
}

/// Reads the files of other job lists in the folder, which have fewer seeds or methods, or other values. Removes
/// job files whose picture is missing, so that these jobs are rendered again.
void Experiment::recall() {
    for (const MeasuredScene& scene : scenes_)
        scene_files_.push_back(
            checksum_of(read_bytes(scene.source().file) + to_text(nlohmann::json(scene.source().variables))));
    std::unordered_set<std::string> own;
    for (std::size_t job = 0; job < jobs_.size(); ++job) {
        const fs::path file = file_of(job);
        own.insert(file.filename().string());
        if (!file.empty() && keeps_image(jobs_[job].seed) && !has_images(jobs_[job]))
            fs::remove(file);
    }
    bool are_others = false;
    for (const fs::directory_entry& entry : fs::directory_iterator(options_.output / "jobs"))
        if (entry.path().extension() == ".jsonl" && !own.contains(entry.path().filename().string())) {
            journal_.read(entry.path());
            are_others = true;
        }
    for (std::size_t job = 0; are_others && job < jobs_.size(); ++job)
        is_recalled_[job] = !file_of(job).empty() && !fs::exists(file_of(job)) && is_known(jobs_[job]);
}

bool Experiment::has_images(const Job& job) const {
    return std::all_of(job.setups.begin(), job.setups.end(), [&](std::size_t i) {
        return fs::exists(image_file(scenes_[job.scene].name(), setups_[i]));
    });
}

/// Returns what the journal has of a run; null if it is missing, of another build or without required artefacts.
nlohmann::json Experiment::find(const Journal& journal, const Job& job, std::size_t setup) const {
    const nlohmann::json known = journal.find(key_of(job.scene, setups_[setup], job.seed));
    if (known.is_null() || (known.at("program") != program_identity() && !options_.takes_any_build))
        return {};
    for (const nlohmann::json& m : known.at("measurements"))
        if (options_.measures_artefacts && !measurement_from_json(m).artefacts)
            return {};
    return known;
}

nlohmann::json Experiment::recalled(const Job& job, std::size_t setup) const {
    const bool has_image =
        !keeps_image(job.seed) || fs::exists(image_file(scenes_[job.scene].name(), setups_[setup]));
    return has_image ? find(journal_, job, setup) : nlohmann::json();
}

bool Experiment::is_known(const Job& job) const {
    return std::none_of(job.setups.begin(), job.setups.end(),
                        [&](std::size_t i) { return recalled(job, i).is_null(); });
}

std::vector<fs::path> Experiment::known_in(std::size_t index) const {
    const Job& job = jobs_[index];
    std::set<fs::path> files;
    for (std::size_t setup : job.setups)
        if (is_recalled_[index])
            files.insert(journal_.file_of(key_of(job.scene, setups_[setup], job.seed)));
    return {files.begin(), files.end()};
}

void Experiment::collect(std::size_t index) {
    if (is_collected_[index] || !is_done(index))
        return;
    const Job& job = jobs_[index];
    Journal own;
    if (!is_recalled_[index])
        own.read(file_of(index));
    for (std::size_t setup : job.setups) {
        const nlohmann::json known = find(is_recalled_[index] ? journal_ : own, job, setup);
        if (known.is_null())
            throw std::runtime_error(
                fmt::format("{}: is damaged; delete it to run the job again", file_of(index).string()));
        for (const nlohmann::json& m : known.at("measurements"))
            records_.push_back({job.scene, setup, known.at("triangles"), measurement_from_json(m)});
    }
    is_collected_[index] = 1;
}

std::vector<Result> Experiment::results() {
    for (std::size_t job = 0; job < jobs_.size(); ++job)
        collect(job);
    std::vector<NamedScene> scenes;
    for (const MeasuredScene& scene : scenes_)
        scenes.push_back({scene.name(), scene.source().file});
    return results_of(records_, scenes, setups_, options_.sharing.takes_any_machine);
}

double Experiment::estimate(std::size_t index) {
    const Job& job = jobs_[index];
    if (options_.effort.unit != Effort::Unit::spp)
        return options_.effort.amount * static_cast<double>(renders_of(job.setups).size());
    collect(index);
    const auto mean = [&](auto counts, auto value) {
        double sum = 0, count = 0;
        for (const Record& record : records_)
            if (record.scene == job.scene && record.measurement.halvings == 0 && counts(record)) {
                sum += value(record.measurement);
                ++count;
            }
        return sum / count; // NaN if there is none
    };
    const auto rendering = [](const Measurement& m) { return m.cpu_seconds - m.reconstruction_cpu_seconds; };
    double seconds = 0;
    for (const Setups& render : renders_of(job.setups)) {
        const double known = mean([&](const Record& r) { return r.setup == render.front(); }, rendering);
        seconds += std::isnan(known) ? mean([](const Record&) { return true; }, rendering) : known;
    }
    return seconds;
}

} // namespace tessera
