#include "app/experiment/result.h"

#include "app/experiment/speed_up.h"
#include "render/io/json_text.h"
#include "render/io/text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

using nlohmann::json;

std::string Journal::line(const json& key, const json& value) {
    return to_text(json{{"key", key}, {"value", value}}) + "\n";
}

void Journal::read(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    files_.push_back(file);
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != text.npos; begin = end + 1) {
        const json line = parse_json(std::string_view(text).substr(begin, end - begin));
        if (line.is_object() && line.contains("key") && line.contains("value"))
            entries_[to_text(line["key"])] = {to_text(line["value"]), files_.size() - 1};
    }
}

json Journal::find(const json& key) const {
    const auto found = entries_.find(to_text(key));
    return found == entries_.end() ? json() : parse_json(found->second.value);
}

std::filesystem::path Journal::file_of(const json& key) const {
    const auto found = entries_.find(to_text(key));
    return found == entries_.end() ? std::filesystem::path() : files_[found->second.file];
}

void Journal::for_each(const std::function<void(const json&, const json&)>& take) const {
    for (const auto& [key, entry] : entries_)
        take(parse_json(key), parse_json(entry.value));
}

std::vector<Result> results_of(const std::vector<Record>& records, const std::vector<NamedScene>& scenes,
                               const std::vector<Setup>& setups, bool takes_any_machine) {
    std::set<std::string> machines;
    for (const Record& record : records)
        machines.insert(record.measurement.machine);
    const bool tells_machines = machines.size() > 1 && !takes_any_machine;
    std::map<std::tuple<std::size_t, std::string, std::size_t, int>, Result> by_place;
    for (const auto& [scene, setup, triangles, measurement] : records) {
        const std::string machine = tells_machines ? measurement.machine : "";
        Result none{
            scenes[scene].name, scenes[scene].file, setups[setup], measurement.halvings, triangles, machine, {}};
        by_place.try_emplace({scene, machine, setup, -measurement.halvings}, std::move(none))
            .first->second.runs.push_back(measurement);
    }
    std::vector<Result> results;
    for (auto& [place, result] : by_place) {
        std::ranges::sort(result.runs, {}, &Measurement::seed); // jobs finish in any order
        results.push_back(std::move(result));
    }
    return results;
}

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double count(const Result& result) {
    return static_cast<double>(result.runs.size());
}

template <class Value>
double mean(const Result& result, Value value) {
    return mean_of(of_runs(result, value));
}

double error(const Measurement& run) {
    return run.floor_free.relative_mse;
}
double cpu_seconds(const Measurement& run) {
    return run.cpu_seconds;
}

Counters total(const Result& result) {
    Counters sum;
    for (const Measurement& run : result.runs)
        sum += run.counters;
    return sum;
}

double fraction(std::uint64_t part, std::uint64_t all) {
    return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : none;
}

const ResultColumn columns[] = {
    {"spp", spp_of},
    {"seeds", count},
    {"triangles", [](const Result& r) { return static_cast<double>(r.triangles); }},
    {"cpu_seconds", cpu_seconds_of},
    {"cpu_seconds_deviation", cpu_seconds_deviation},
    {"reconstruction_cpu_seconds",
     [](const Result& r) { return mean(r, [](const Measurement& m) { return m.reconstruction_cpu_seconds; }); }},
    {"wall_seconds", wall_seconds_of},
    {"megasamples_per_wall_second", speed_of},
    {"relmse", [](const Result& r) { return mean(r, [](const Measurement& run) { return run.relative_mse; }); }},
    {"relmse_floor_free", [](const Result& r) { return is_significant(r) ? error_of(r) : none; }},
    {"relmse_floor_free_uncertainty", error_uncertainty},
    {"below_uncertainty", [](const Result& r) { return is_significant(r) ? 0.0 : 1.0; }},
    {"relmse_floor_free_deviation", error_deviation},
    {"efficiency", efficiency_of},
    {"reused_share", reused_fraction},
    {"skipped_share", skipped_fraction},
    {"dark_share", dark_fraction},
    {"shift_attempts", [](const Result& r) { return static_cast<double>(total(r).shift_attempts()) / count(r); }},
    {"shift_success_share",
     [](const Result& r) {
         const Counters sum = total(r);
         return fraction(sum.shifts[static_cast<std::size_t>(ShiftOutcome::ok)], sum.shift_attempts());
     }},
    {"mean_path_vertices",
     [](const Result& r) { return fraction(total(r).path_vertices, total(r).camera_paths); }},
    {"tile_error_spectrum",
     [](const Result& r) {
         return mean(r, [](const Measurement& m) { return m.tiles ? m.tiles->error : none; });
     }},
    {"tile_edge_spectrum",
     [](const Result& r) {
         return mean(r, [](const Measurement& m) { return m.tiles ? m.tiles->edges : none; });
     }},
    {"tile_edge_ratio",
     [](const Result& r) {
         return mean(r, [](const Measurement& m) { return m.tiles ? m.tiles->edge_ratio : none; });
     }},
    {"psnr", [](const Result& r) { return mean(r, [](const Measurement& m) { return m.psnr; }); }},
    {"flip", [](const Result& r) { return mean(r, [](const Measurement& m) { return m.flip; }); }},
    {"rays", [](const Result& r) { return static_cast<double>(total(r).all_rays()) / count(r); }},
};

} // namespace

std::span<const ResultColumn> result_columns() {
    return columns;
}

double column_value(std::string_view id, const Result& result) {
    const auto has_id = [&](const ResultColumn& c) { return c.id == id; };
    return std::find_if(std::begin(columns), std::end(columns), has_id)->value(result);
}

double error_of(const Result& r) {
    return mean(r, error);
}
double error_deviation(const Result& r) {
    return deviation_of(of_runs(r, error));
}
double error_uncertainty(const Result& r) {
    const double of_pieces = mean(r, [](const Measurement& run) { return run.floor_free.standard_error; });
    const double of_seeds = error_deviation(r) / std::sqrt(count(r));
    return of_seeds > of_pieces ? of_seeds : of_pieces; // false if of_seeds is NaN
}
bool is_significant(const Result& r) {
    return error_of(r) > error_uncertainty(r);
}
double spp_of(const Result& r) {
    return mean(r, [](const Measurement& run) { return run.spp; });
}
double wall_seconds_of(const Result& r) {
    return mean(r, [](const Measurement& run) { return run.wall_seconds; });
}
double speed_of(const Result& r) {
    const glm::ivec2 size = r.setup.settings.size;
    return 1e-6 * size.x * size.y * spp_of(r) / wall_seconds_of(r);
}
double cpu_seconds_of(const Result& r) {
    return mean(r, cpu_seconds);
}
double cpu_seconds_deviation(const Result& r) {
    return deviation_of(of_runs(r, cpu_seconds));
}

double efficiency_of(const Result& r) {
    const double cost = error_of(r) * cpu_seconds_of(r);
    return is_significant(r) && cost > 0 ? 1 / cost : none;
}

double reused_fraction(const Result& r) {
    return fraction(total(r).reused_paths, total(r).set_paths());
}
double skipped_fraction(const Result& r) {
    return fraction(total(r).skipped_paths, total(r).set_paths());
}
double dark_fraction(const Result& r) {
    return fraction(total(r).dark_paths, total(r).set_paths());
}

} // namespace tessera
