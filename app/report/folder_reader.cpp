#include "app/report/folder_reader.h"

#include "app/experiment/claim.h"
#include "app/experiment/plan.h"
#include "app/report/reports.h"
#include "render/io/json_text.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The names in a folder.
struct Names {
    std::unordered_set<std::string> files, claimed; ///< of claims, those of what is claimed
};

Names names_in(const fs::path& folder) {
    Names names;
    std::error_code none; // a scene's folder may not be there yet
    for (fs::directory_iterator it(folder, none); !none && it != fs::directory_iterator(); it.increment(none)) {
        const std::string name = it->path().filename().string();
        if (std::string file = claimed_by(name); !file.empty())
            names.claimed.insert(std::move(file));
        else
            names.files.insert(name);
    }
    return names;
}

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
        std::vector<Chart> charts;
        if (plan_.options.halvings > 0) {
            for (const SceneCurves& scene : curves_by_scene(results))
                charts.push_back(bench_chart(plan_.options, scene));
            return charts;
        }
        for (auto begin = results.begin(); begin != results.end();) {
            const auto end =
                std::find_if(begin, results.end(), [&](const Result& r) { return r.title() != begin->title(); });
            charts.push_back(sweep_chart(plan_.options, {begin, end}));
            begin = end;
        }
        return charts;
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
        const bool is_new = read_plan_if_new();
        FollowedFolder now = seen_;
        now.jobs = states();
        for (std::size_t i = 0; i < now.jobs.size(); ++i)
            if (now.jobs[i].state == FollowedJob::State::done && !is_read_[i])
                read(i, now);
        if (!is_new && now.jobs == seen_.jobs)
            return {};
        if (std::exchange(has_more_, false) || is_new) {
            now.charts.clear();
            for (const Work& work : works_)
                for (Chart& chart : work.charts())
                    now.charts.push_back(std::move(chart));
        }
        seen_ = now;
        return std::make_shared<const FollowedFolder>(std::move(now));
    }

private:
    /// Throws where there is no plan.
    bool read_plan_if_new() {
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
            return false;
        plan_ = read_plan(file);
        mark_ = mark;
        works_.clear();
        for (const JobPlan::Work& work : plan_.works)
            works_.emplace_back(work);
        is_read_.assign(plan_.jobs.size(), 0);
        seen_ = {};
        seen_.command = plan_.works.empty() ? "" : plan_.works.front().options.command;
        return true;
    }

    std::vector<FollowedJob> states() {
        using State = FollowedJob::State;
        std::map<fs::path, Names> folders;
        std::vector<FollowedJob> jobs;
        for (const JobPlan::Job& job : plan_.jobs) {
            FollowedJob& now = jobs.emplace_back(FollowedJob{job.what});
            if (job.is_known)
                now.state = State::done;
            if (job.is_known || job.file.empty())
                continue;
            const auto [folder, is_new] = folders.try_emplace(job.file.parent_path());
            if (is_new)
                folder->second = names_in(folder_ / job.file.parent_path());
            const std::string name = job.file.filename().string();
            if (folder->second.files.contains(name))
                now.state = State::done;
            else if (folder->second.claimed.contains(name))
                now = {job.what, State::claimed, Claims::owner_of(folder_ / job.file)};
        }
        return jobs;
    }

    /// Takes in what a job has found; of one that is known, all that other lists have.
    void read(std::size_t job, FollowedFolder& now) {
        is_read_[job] = 1;
        const JobPlan::Job& of = plan_.jobs[job];
        if (of.is_reference)
            return;
        has_more_ = true;
        if (!of.is_known)
            return read(works_[of.work], folder_ / of.file, now);
        std::error_code none;
        for (fs::directory_iterator it((folder_ / of.file).parent_path(), none);
             !none && it != fs::directory_iterator(); it.increment(none))
            if (it->path().extension() == ".jsonl")
                read(works_[of.work], it->path(), now);
        for (std::size_t other = 0; other < plan_.jobs.size(); ++other)
            if (plan_.jobs[other].is_known)
                is_read_[other] = 1;
    }

    static void read(Work& work, const fs::path& file, FollowedFolder& now) {
        try {
            work.read(file);
        } catch (const std::exception& error) {
            now.trouble.push_back(fmt::format("{}: {}", file.string(), error.what()));
        }
    }

    fs::path folder_;
    std::string mark_; ///< of the plan that was read
    JobPlan plan_;
    std::vector<Work> works_;           ///< of the plan
    std::vector<std::uint8_t> is_read_; ///< 1: what the job has found is taken in
    bool has_more_ = false;             ///< than the charts show
    FollowedFolder seen_;
};

} // namespace

FolderReader folder_reader(const fs::path& folder) {
    return [reader = std::make_shared<Reader>(folder)] { return reader->look(); };
}

} // namespace tessera
