#include "app/stats.h"

#include "app/process_usage.h"

#include <nlohmann/json.hpp>

namespace tessera {

using nlohmann::json;

json counters_json(const Counters& c) {
    json outcomes = json::object();
    for (int i = 0; i < shift_outcome_count; ++i)
        outcomes[std::string(to_string(static_cast<ShiftOutcome>(i)))] = c.shifts[static_cast<std::size_t>(i)];
    json rays = json::object();
    for (int i = 0; i < ray_kind_count; ++i)
        rays[std::string(to_string(static_cast<RayKind>(i)))] = c.rays[static_cast<std::size_t>(i)];
    const double paths = static_cast<double>(std::max<std::uint64_t>(c.camera_paths, 1));
    const double set_paths = static_cast<double>(std::max<std::uint64_t>(c.set_paths(), 1));
    return {{"camera_paths", c.camera_paths},
            {"mean_path_vertices", static_cast<double>(c.path_vertices) / paths},
            {"rays", rays},
            {"reuse",
             {{"dark_paths", c.dark_paths},
              {"skipped_by_roulette", c.skipped_paths},
              {"reused_paths", c.reused_paths},
              {"reused_share", static_cast<double>(c.reused_paths) / set_paths},
              {"skipped_share", static_cast<double>(c.skipped_paths) / set_paths},
              {"light_paths_skipped_by_weight", c.skipped_light_paths}}},
            {"shifts", {{"attempts", c.shift_attempts()}, {"outcomes", outcomes}}},
            {"refused_samples", c.refused_samples}};
}

json reconstructions_json(const std::vector<ReconstructionStats>& reconstructions) {
    json recon = json::array();
    for (const ReconstructionStats& r : reconstructions)
        recon.push_back({{"norm", to_string(r.norm)},
                         {"wall", r.seconds},
                         {"cpu", r.cpu_seconds},
                         {"iterations", r.iterations},
                         {"residual", r.residual}});
    return recon;
}

json stats_json(const json& settings, const OpenedScene& opened, const Render& render, int threads,
                const std::vector<ReconstructionStats>& reconstructions, bool interrupted) {
    json stats{
        {"settings", settings},
        {"threads", threads},
        {"interrupted", interrupted},
        {"seconds",
         {{"load", {{"wall", opened.parse_seconds + opened.file_seconds}, {"cpu", opened.load_cpu_seconds}}},
          {"bvh", {{"wall", opened.bvh_seconds}, {"cpu", opened.bvh_cpu_seconds}}},
          {"render", {{"wall", render.seconds()}, {"cpu", render.cpu_seconds()}}},
          {"reconstruct", reconstructions_json(reconstructions)}}},
        {"peak_memory", peak_memory_bytes()},
        {"spp", render.spp()}};
    stats.update(counters_json(render.counters()));
    return stats;
}

} // namespace tessera
