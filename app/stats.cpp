#include "app/stats.h"

#include "app/process_usage.h"

#include <nlohmann/json.hpp>

namespace tessera {

using nlohmann::json;

json settings_json(const SceneSource& scene, const RenderSettings& s, glm::ivec2 size, int spp, float alpha) {
    return {{"version", TESSERA_VERSION},
            {"scene", to_string(scene)},
            {"variables", scene.variables},
            {"camera", scene.camera.string()},
            {"method", short_name(s.method)},
            {"width", size.x},
            {"height", size.y},
            {"spp", spp},
            {"max_depth", s.max_depth},
            {"tile", s.tile},
            {"rr_delta", s.rr_delta},
            {"q_min", s.q_min},
            {"shift_threshold", s.shift_threshold},
            {"alpha", alpha},
            {"seed", s.seed}};
}

namespace {

json counters_json(const Counters& c) {
    json outcomes = json::object();
    for (int i = 0; i < shift_outcome_count; ++i)
        outcomes[std::string(to_string(static_cast<ShiftOutcome>(i)))] = c.shifts[static_cast<std::size_t>(i)];
    const double paths = static_cast<double>(std::max<std::uint64_t>(c.camera_paths, 1));
    return {{"camera_paths", c.camera_paths},
            {"mean_path_vertices", static_cast<double>(c.path_vertices) / paths},
            {"rays", {{"closest_hit", c.closest_hit_rays}, {"occlusion", c.occlusion_rays}}},
            {"reuse", {{"paths_with_light", c.reusable_paths}, {"skipped_by_roulette", c.skipped_paths}}},
            {"shifts", {{"attempts", c.shift_attempts()}, {"outcomes", outcomes}}},
            {"refused_samples", c.refused_samples}};
}

} // namespace

json stats_json(const json& settings, const OpenedScene& opened, const Render& render, int threads,
                const std::vector<ReconstructionStats>& reconstructions, bool interrupted) {
    json recon = json::array();
    for (const ReconstructionStats& r : reconstructions)
        recon.push_back({{"norm", to_string(r.norm)},
                         {"wall", r.seconds},
                         {"cpu", r.cpu_seconds},
                         {"iterations", r.iterations},
                         {"residual", r.residual}});
    json stats{
        {"settings", settings},
        {"threads", threads},
        {"interrupted", interrupted},
        {"seconds",
         {{"load", {{"wall", opened.parse_seconds + opened.file_seconds}, {"cpu", opened.load_cpu_seconds}}},
          {"bvh", {{"wall", opened.bvh_seconds}, {"cpu", opened.bvh_cpu_seconds}}},
          {"render", {{"wall", render.seconds()}, {"cpu", render.cpu_seconds()}}},
          {"reconstruct", recon}}},
        {"peak_memory", peak_memory_bytes()},
        {"spp", render.spp()}};
    stats.update(counters_json(render.counters()));
    return stats;
}

} // namespace tessera
