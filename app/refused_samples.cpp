#include "app/refused_samples.h"

#include "app/setting_options.h"
#include "ui/render_size.h"

#include <algorithm>
#include <string_view>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

/// As one word of a shell's command line.
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

std::string inspect_command(const SceneSource& source, const Render& render, const RefusedSample& sample) {
    if (std::max(render.size().x, render.size().y) > most_render_pixels_an_edge)
        return "";
    const RenderSettings& settings = render.settings();
    RenderSettings usual;
    usual.max_depth = std::min(render.scene()->max_depth(), most_edges);
    std::string command = "tessera view";
    if (!source.file.empty())
        command += " " + shell_word(source.file.string());
    for (const auto& [name, value] : source.variables)
        command += " -D " + shell_word(name + "=" + value);
    if (!source.camera.empty())
        command += " --camera " + shell_word(source.camera.string());
    if (settings.method != usual.method)
        command += fmt::format(" -m {}", short_name(settings.method));
    command += fmt::format(" --size {}x{}", render.size().x, render.size().y) + option_words(usual, settings);
    if (settings.seed != usual.seed)
        command += fmt::format(" --seed {}", settings.seed);
    return command + fmt::format(" --inspect {},{},{}", sample.x, sample.y, sample.pass);
}

void warn_of_refused(const SceneSource& source, const Render& render) {
    const auto first = render.counters().first_refused.list();
    if (first.empty())
        return;
    const std::string command = inspect_command(source, render, first.front());
    fmt::print(stderr, "warning: {}\n{}\n", refused_text(render.counters(), render.settings().seed),
               command.empty()
                   ? fmt::format("The viewer cannot open it: its pictures have up to {} pixels an edge.",
                                 most_render_pixels_an_edge)
                   : "The same scene, size, settings and seed open it in the viewer:\n    " + command);
}

nlohmann::json refused_json(const SceneSource& source, const Render& render) {
    nlohmann::json list = nlohmann::json::array();
    for (const RefusedSample& sample : render.counters().first_refused.list()) {
        list.push_back(
            {{"x", sample.x}, {"y", sample.y}, {"pass", sample.pass}, {"seed", render.settings().seed}});
        if (const std::string command = inspect_command(source, render, sample); !command.empty())
            list.back()["inspect"] = command;
    }
    return list;
}

} // namespace tessera
