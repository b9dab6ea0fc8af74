#include "app/cli/render_stats.h"

#include "app/cli/option_values.h"
#include "app/cli/terminal.h"
#include "render/scene/scene.h"
#include "ui/state/viewer_state.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

/// Quotes the text for a shell.
std::string shell_word(const std::string& text) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./=,:+@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos)
        return text;
    std::string word = "'";
    for (char c : text)
        word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

} // namespace

std::string inspect_command(const SceneSource& source, const Render& render, const InvalidSample& sample) {
    if (std::max(render.size().x, render.size().y) > most_render_pixels_an_edge)
        return "";
    const RenderSettings& settings = render.settings();
    RenderSettings defaults;
    defaults.max_depth = std::min(render.scene()->max_depth(), most_edges);
    std::string command = "tessera view";
    if (!source.file.empty())
        command += " " + shell_word(source.file.string());
    for (const auto& [name, value] : source.variables)
        command += " -D " + shell_word(name + "=" + value);
    if (!source.camera.empty())
        command += " --camera " + shell_word(source.camera.string());
    if (!source.sensor.empty())
        command += " --sensor " + shell_word(source.sensor);
    glm::ivec2 film = render.size();
    if (const CropWindow& crop = render.camera().crop; !crop.empty()) {
        const glm::dvec2 scale = glm::dvec2(render.size()) / glm::dvec2(crop.size);
        const auto scaled = [&](glm::ivec2 pixels) { return glm::ivec2(glm::round(glm::dvec2(pixels) * scale)); };
        film = scaled(crop.film);
        command += " --crop " + text_of({film, scaled(crop.offset), render.size()});
    } else if (source.crop) {
        command += " --crop none";
    }
    if (settings.method != defaults.method)
        command += fmt::format(" -m {}", short_name(settings.method));
    command += fmt::format(" --size {}x{}", film.x, film.y) + option_words(defaults, settings);
    if (settings.seed != defaults.seed)
        command += fmt::format(" --seed {}", settings.seed);
    return command + fmt::format(" --inspect {},{},{}", sample.x, sample.y, sample.pass);
}

void warn_of_invalid_samples(const SceneSource& source, const Render& render) {
    const auto first = render.counters().first_invalid.list();
    if (first.empty())
        return;
    const std::string command = inspect_command(source, render, first.front());
    fmt::print(stderr, "warning: {}\n{}\n", invalid_text(render.counters(), render.settings().seed),
               command.empty()
                   ? fmt::format("The viewer cannot open it: it supports at most {} pixels along each edge.",
                                 most_render_pixels_an_edge)
                   : "This command opens it in the viewer:\n    " + command);
}

nlohmann::json invalid_samples_json(const SceneSource& source, const Render& render) {
    nlohmann::json list = nlohmann::json::array();
    for (const InvalidSample& sample : render.counters().first_invalid.list()) {
        list.push_back(
            {{"x", sample.x}, {"y", sample.y}, {"pass", sample.pass}, {"seed", render.settings().seed}});
        if (const std::string command = inspect_command(source, render, sample); !command.empty())
            list.back()["inspect"] = command;
    }
    return list;
}

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
              {"skipped_share", static_cast<double>(c.skipped_paths) / set_paths}}},
            {"shifts", {{"attempts", c.shift_attempts()}, {"outcomes", outcomes}}},
            {"refused_samples", c.invalid_samples}};
}

void print_redistributed(const std::filesystem::path& output,
                         const std::vector<ReconstructionStats>& reconstructions) {
    for (const ReconstructionStats& r : reconstructions)
        if (r.redistributed > 0)
            fmt::print(stderr, "{}: {}, fireflies: {:.2g} % of the radiance redistributed\n", output.string(),
                       to_string(r.norm), 100 * r.redistributed);
}

json reconstructions_json(const std::vector<ReconstructionStats>& reconstructions) {
    json recon = json::array();
    for (const ReconstructionStats& r : reconstructions)
        recon.push_back({{"norm", to_string(r.norm)},
                         {"wall", r.seconds},
                         {"cpu", r.cpu_seconds},
                         {"iterations", r.iterations},
                         {"residual", r.residual},
                         {"redistributed", r.redistributed}});
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
