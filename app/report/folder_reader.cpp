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

/// A key without its seed, as text, and without what only the worker knows.
std::string without_seed(json key) {
    key["settings"].erase("seed");
    for (const char* other : {"scene_file", "reference"})
        key.erase(other);
    return to_text(key);
}

/// What is found of an experiment.
class Work {
public:
    explicit Work(const JobPlan::Work& plan)
        : plan_(plan), setups_(setups_of(plan.options.settings, plan.options.methods, plan.options.norms,
                                         plan.options.variations)) {
        for (std::size_t scene = 0; scene < plan.scenes.size(); ++scene)
            for (std::size_t setup = 0; setup < setups_.size(); ++setup)
                places_[without_seed(key_of_run(plan.options, plan.scenes[scene], setups_[setup], 0))] = {scene,
                                                                                                          setup};
    }

    /// Takes in a job's file. Throws std::exception where it is none, or cannot be read.
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
        const auto place = places_.find(without_seed(key));
        if (place == places_.end())
            return; // of another list
        const auto [scene, setup] = place->second;
        for (const json& m : value.at("measurements")) {
            Measurement measurement = measurement_from_json(m);
            const std::uint64_t first = plan_.options.settings.render.seed;
            const bool is_asked_for = measurement.seed - first < static_cast<std::uint64_t>(plan_.options.seeds);
            if (is_asked_for && seen_.emplace(scene, setup, measurement.seed, measurement.halvings).second)
                records_.push_back({scene, setup, value.at("triangles"), std::move(measurement)});
        }
    }

    JobPlan::Work plan_;
    std::vector<Setup> setups_;
    std::map<std::string, std::pair<std::size_t, std::size_t>> places_; ///< scene and setup by keys
    std::set<std::tuple<std::size_t, std::size_t, std::uint64_t, int>> seen_;
    std::vector<Record> records_;
};

class Reader {
public:
    explicit Reader(fs::path folder) : folder_(std::move(folder)) {}

    std::shared_ptr<const FollowedFolder> look() {
        read_plan_if_new();
        FollowedFolder now = seen_;
        now.jobs = states();
        for (std::size_t i = 0; i < now.jobs.size(); ++i)
            if (now.jobs[i].state == FollowedJob::State::done && !is_read_[i])
                read(i);
        now.trouble.clear();
        for (const auto& [file, text] : trouble_)
            now.trouble.push_back(text);
        if (!is_new_ && now.jobs == seen_.jobs && now.trouble == seen_.trouble)
            return {};
        if (has_more_ || is_new_) {
            now.charts.clear();
            for (const Work& work : works_)
                for (Chart& chart : work.charts())
                    now.charts.push_back(std::move(chart));
        }
        seen_ = now;
        is_new_ = has_more_ = false;
        return std::make_shared<const FollowedFolder>(std::move(now));
    }

private:
    /// Throws where there is no plan.
    void read_plan_if_new() {
        std::error_code ignored;
        if (!fs::exists(folder_, ignored))
            throw std::runtime_error(folder_.string() + ": there is no such folder");
        if (!fs::is_directory(folder_, ignored))
            throw std::runtime_error(folder_.string() + ": is no folder");
        const fs::path file = plan_file(folder_);
        const std::string mark = plan_mark(file);
        if (mark.empty())
            throw std::runtime_error(
                fmt::format("{}: no tessera bench, sweep or stability of this version has begun in that folder "
                            "(it has no {})",
                            folder_.string(), file.lexically_relative(folder_).string()));
        if (mark == mark_)
            return;
        JobPlan plan = read_plan(file);
        std::vector<Work> works(plan.works.begin(), plan.works.end());
        seen_ = {};
        seen_.command = plan.works.empty() ? "" : plan.works.front().options.command;
        is_read_.assign(plan.jobs.size(), 0);
        trouble_.clear();
        plan_ = std::move(plan);
        works_ = std::move(works);
        is_new_ = true;
        mark_ = mark; // last: what throws before that is told again by the next look
    }

    /// Throws where a folder that is there cannot be listed.
    std::vector<FollowedJob> states() {
        using State = FollowedJob::State;
        std::map<fs::path, Listing> folders;
        std::vector<FollowedJob> jobs;
        for (const JobPlan::Job& job : plan_.jobs) {
            FollowedJob& now = jobs.emplace_back(FollowedJob{job.what});
            if (!job.known_in.empty())
                now.state = State::done;
            if (!job.known_in.empty() || job.file.empty())
                continue;
            const Listing& listing = listing_of(folder_ / job.file.parent_path(), folders);
            const std::string name = job.file.filename().string();
            if (listing.files.contains(name))
                now.state = State::done;
            else if (listing.claimed.contains(name))
                now = {job.what, State::claimed, Claims::owner_of(folder_ / job.file)};
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

    /// Takes in what a job has found; where that fails, the next look tries again.
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
            has_more_ = true;
            work.read(file);
            trouble_.erase(file);
            return true;
        } catch (const std::exception& error) {
            trouble_[file] = fmt::format("{}: {}", file.string(), error.what());
            return false;
        }
    }

    fs::path folder_;
    std::string mark_; ///< of the plan that was read
    JobPlan plan_;
    std::vector<Work> works_;                 ///< of the plan
    std::vector<std::uint8_t> is_read_;       ///< 1: what the job has found is taken in
    std::map<fs::path, std::string> trouble_; ///< of files, those that cannot be read
    bool is_new_ = false;                     ///< the plan, which nobody has been told of
    bool has_more_ = false;                   ///< than the charts show
    FollowedFolder seen_;
};

} // namespace

FolderReader folder_reader(const fs::path& folder) {
    return [reader = std::make_shared<Reader>(folder)] { return reader->look(); };
}

} // namespace tessera
