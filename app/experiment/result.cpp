#include "app/experiment/result.h"

#include "app/experiment/speed_up.h"
#include "render/io/files.h"
#include "render/io/json_text.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace tessera {

namespace {

using nlohmann::json;

std::string text_of(const std::filesystem::path& file) {
    return std::filesystem::exists(file) ? read_text(file) : std::string();
}

/// Adds the text to the file's end, where it is on the disk when this returns.
void append(const std::filesystem::path& file, const std::string& text) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    const bool written = descriptor >= 0 &&
                         ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                         ::fsync(descriptor) == 0;
    const std::string reason = std::strerror(errno);
    if (descriptor >= 0)
        ::close(descriptor);
    if (!written)
        throw std::runtime_error(fmt::format("{}: cannot be written: {}", file.string(), reason));
}

} // namespace

Journal::Journal(std::filesystem::path file) : file_(std::move(file)) {
    const std::string text = text_of(file_);
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != text.npos; begin = end + 1) {
        const json line = parse_json(std::string_view(text).substr(begin, end - begin));
        if (line.is_object() && line.contains("key") && line.contains("value"))
            entries_[to_text(line["key"])] = to_text(line["value"]);
    }
    append(file_, begin < text.size() ? "\n" : "");                            // the torn line ends here
    write_through_folder(file_.has_parent_path() ? file_.parent_path() : "."); // the file may be new in it
}

json Journal::find(const json& key) const {
    const auto found = entries_.find(to_text(key));
    return found == entries_.end() ? json() : parse_json(found->second);
}

void Journal::record(const json& key, const json& value) {
    append(file_, to_text(json{{"key", key}, {"value", value}}) + "\n");
    entries_[to_text(key)] = to_text(value);
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

double share(std::uint64_t part, std::uint64_t all) {
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
    {"relmse_floor_free", [](const Result& r) { return is_certain(r) ? error_of(r) : none; }},
    {"relmse_floor_free_uncertainty", error_uncertainty},
    {"below_uncertainty", [](const Result& r) { return is_certain(r) ? 0.0 : 1.0; }},
    {"relmse_floor_free_deviation", error_deviation},
    {"efficiency", efficiency_of},
    {"reused_share", reused_share},
    {"skipped_share", skipped_share},
    {"dark_share", dark_share},
    {"shift_attempts", [](const Result& r) { return static_cast<double>(total(r).shift_attempts()) / count(r); }},
    {"shift_success_share",
     [](const Result& r) {
         const Counters sum = total(r);
         return share(sum.shifts[static_cast<std::size_t>(ShiftOutcome::ok)], sum.shift_attempts());
     }},
    {"mean_path_vertices", [](const Result& r) { return share(total(r).path_vertices, total(r).camera_paths); }},
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
    return of_seeds > of_pieces ? of_seeds : of_pieces; // of_seeds may be no number
}
bool is_certain(const Result& r) {
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
    return is_certain(r) && cost > 0 ? 1 / cost : none;
}

double reused_share(const Result& r) {
    return share(total(r).reused_paths, total(r).set_paths());
}
double skipped_share(const Result& r) {
    return share(total(r).skipped_paths, total(r).set_paths());
}
double dark_share(const Result& r) {
    return share(total(r).dark_paths, total(r).set_paths());
}

} // namespace tessera
