#include "app/experiment/claim.h"
#include "app/experiment/plan.h"
#include "app/report/reports.h"
#include "render/io/json_text.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Returns a run's key as text, without its seed and the checksums that only workers know.
std::string without_seed(json key) {
    key["settings"].erase("seed");
    for (const char* other : {"scene_file", "reference"})
        key.erase(other);
    return to_text(key);
}

/// The finished results of one experiment.
class Work {
public:
    explicit Work(const JobPlan::Work& plan)
        : plan_(plan), setups_(setups_of(plan.options.settings, plan.options.methods, plan.options.norms,
                                         plan.options.variations)) {
        for (std::size_t scene = 0; scene < plan.scenes.size(); ++scene)
            for (std::size_t setup = 0; setup < setups_.size(); ++setup)
                indices_[without_seed(key_of_run(plan.options, plan.scenes[scene], setups_[setup], 0))] = {scene,
                                                                                                           setup};
    }

    /// Adds the results of a job's file. Throws std::exception if it cannot be read.
    void read(const fs::path& file) {
        Journal journal;
        journal.read(file);
        journal.for_each([&](const json& key, const json& value) { take(key, value); });
    }

    std::vector<Chart> charts() const {
        std::vector<NamedScene> scenes;
        for (const std::string& name : plan_.scenes)
            scenes.push_back({name, {}});
        const std::vector<Result> results =
            results_of(records_, scenes, setups_, plan_.options.sharing.takes_any_machine);
        if (plan_.options.halvings > 0) {
            std::vector<Chart> charts;
            for (const SceneCurves& scene : curves_by_scene(results))
                charts.push_back(bench_chart(plan_.options, scene));
            return charts;
        }
        return sweep_charts(plan_.options, results);
    }

private:
    void take(const json& key, const json& value) {
        const auto place = indices_.find(without_seed(key));
        if (place == indices_.end())
            return; // a run of another job list
        const auto [scene, setup] = place->second;
        for (const json& m : value.at("measurements")) {
            Measurement measurement = measurement_from_json(m);
            const std::uint64_t first = plan_.options.settings.render.seed;
            const bool is_asked_for = measurement.seed - first < static_cast<std::uint64_t>(plan_.options.seeds);
            if (is_asked_for && known_runs_.emplace(scene, setup, measurement.seed, measurement.halvings).second)
                records_.push_back({scene, setup, value.at("triangles"), std::move(measurement)});
        }
    }

    JobPlan::Work plan_;
    std::vector<Setup> setups_;
    std::map<std::string, std::pair<std::size_t, std::size_t>> indices_; ///< scene and setup by key
    std::set<std::tuple<std::size_t, std::size_t, std::uint64_t, int>> known_runs_;
    std::vector<Record> records_;
};

class Reader {
public:
    explicit Reader(fs::path folder) : folder_(std::move(folder)) {}

    std::shared_ptr<const FollowedFolder> read_changes() {
        read_plan_if_new();
        FollowedFolder current = last_;
        current.jobs = states();
        for (std::size_t i = 0; i < current.jobs.size(); ++i)
            if (current.jobs[i].state == FollowedJob::State::done && !is_read_[i])
                read(i);
        current.trouble.clear();
        for (const auto& [file, text] : errors_)
            current.trouble.push_back(text);
        if (!is_plan_new_ && current.jobs == last_.jobs && current.trouble == last_.trouble)
            return {};
        if (are_charts_old_ || is_plan_new_) {
            current.charts.clear();
            for (const Work& work : works_)
                for (Chart& chart : work.charts())
                    current.charts.push_back(std::move(chart));
        }
        last_ = current;
        is_plan_new_ = are_charts_old_ = false;
        return std::make_shared<const FollowedFolder>(std::move(current));
    }

private:
    /// Reads the plan if it has changed. Throws std::runtime_error if there is none.
    void read_plan_if_new() {
        std::error_code ignored;
        if (!fs::exists(folder_, ignored))
            throw std::runtime_error(folder_.string() + ": there is no such folder");
        if (!fs::is_directory(folder_, ignored))
            throw std::runtime_error(folder_.string() + ": is not a folder");
        const fs::path file = plan_file(folder_);
        const std::string mark = plan_mark(file);
        if (mark.empty())
            throw std::runtime_error(
                fmt::format("{}: no tessera bench, sweep or stability of this version has started in this "
                            "folder (it has no {})",
                            folder_.string(), file.lexically_relative(folder_).string()));
        if (mark == mark_)
            return;
        JobPlan plan = read_plan(file);
        std::vector<Work> works(plan.works.begin(), plan.works.end());
        last_ = {};
        last_.command = plan.works.empty() ? "" : plan.works.front().options.command;
        is_read_.assign(plan.jobs.size(), 0);
        errors_.clear();
        plan_ = std::move(plan);
        works_ = std::move(works);
        is_plan_new_ = true;
        mark_ = mark; // last: an exception before is thrown again at the next call
    }

    /// Returns the states of the jobs. Throws if an existing folder cannot be listed.
    std::vector<FollowedJob> states() {
        using State = FollowedJob::State;
        std::map<fs::path, Listing> folders;
        std::vector<FollowedJob> jobs;
        for (const JobPlan::Job& job : plan_.jobs) {
            FollowedJob& current = jobs.emplace_back(FollowedJob{job.what});
            if (!job.known_in.empty())
                current.state = State::done;
            if (!job.known_in.empty() || job.file.empty())
                continue;
            const Listing& listing = listing_of(folder_ / job.file.parent_path(), folders);
            const std::string name = job.file.filename().string();
            if (listing.files.contains(name))
                current.state = State::done;
            else if (listing.claimed.contains(name))
                current = {job.what, State::claimed, Claims::owner_of(folder_ / job.file)};
        }
        return jobs;
    }

    static const Listing& listing_of(const fs::path& folder, std::map<fs::path, Listing>& known) {
        const auto [entry, is_new] = known.try_emplace(folder);
        if (is_new)
            entry->second = list(folder);
        if (const std::error_code error = entry->second.error)
            throw std::runtime_error(
                fmt::format("{}: cannot be listed: {}", folder.lexically_normal().string(), error.message()));
        return entry->second;
    }

    /// Adds the results of a job. If that fails, the next call tries again.
    void read(std::size_t job) {
        const JobPlan::Job& of = plan_.jobs[job];
        bool is_whole = true;
        for (const fs::path& file : of.known_in)
            is_whole = read(works_[of.work], folder_ / file) && is_whole;
        if (of.known_in.empty() && !of.is_reference)
            is_whole = read(works_[of.work], folder_ / of.file);
        is_read_[job] = is_whole;
    }

    bool read(Work& work, const fs::path& file) {
        try {
            are_charts_old_ = true;
            work.read(file);
            errors_.erase(file);
            return true;
        } catch (const std::exception& error) {
            errors_[file] = fmt::format("{}: {}", file.string(), error.what());
            return false;
        }
    }

    fs::path folder_;
    std::string mark_; ///< checksum line of the plan that was read
    JobPlan plan_;
    std::vector<Work> works_;                ///< one for each experiment of the plan
    std::vector<std::uint8_t> is_read_;      ///< 1: the job's results are added
    std::map<fs::path, std::string> errors_; ///< error messages by file
    bool is_plan_new_ = false;               ///< the plan has not been returned yet
    bool are_charts_old_ = false;            ///< results were added since the last charts
    FollowedFolder last_;
};

} // namespace

FolderReader folder_reader(const fs::path& folder) {
    return [reader = std::make_shared<Reader>(folder)] { return reader->read_changes(); };
}

} // namespace tessera
