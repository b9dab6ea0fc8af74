#include "app/cli/option_values.h"

#include "app/cli/terminal.h"
#include "recon/picture/oidn.h"
#include "render/io/files.h"
#include "render/io/text.h"
#include "ui/state/inspected.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <span>
#include <stdexcept>
#include <system_error>
#include <variant>

#include <CLI/CLI.hpp>
#include <CLI/StringTools.hpp>
#include <fmt/core.h>

namespace tessera {

glm::ivec2 parse_size(const std::string& option, const std::string& text) {
    glm::ivec2 size(0);
    const Setting setting = size_setting(size);
    try {
        setting.set_text(text);
    } catch (const std::invalid_argument&) {
        throw BadInput(fmt::format("{} {}: must be {}", option, text, setting.allowed()));
    }
    try {
        check_image_size(size.x, size.y);
    } catch (const std::runtime_error& error) {
        throw BadInput(fmt::format("{} {}: {}", option, text, error.what()));
    }
    return size;
}

CropWindow parse_crop(const std::string& text, glm::ivec2 film) {
    CropWindow crop{film};
    if (text == "none")
        return crop;
    int end = 0;
    if (std::sscanf(text.c_str(), "%9d,%9d,%9dx%9d%n", &crop.offset.x, &crop.offset.y, &crop.size.x, &crop.size.y,
                    &end) != 4 ||
        end != static_cast<int>(text.size()) || crop.offset.x < 0 || crop.offset.y < 0 || crop.size.x < 1 ||
        crop.size.y < 1)
        throw BadInput(fmt::format("--crop {}: must be X,Y,WIDTHxHEIGHT in pixels, or none", text));
    return crop;
}

SceneVariables parse_variables(const std::vector<std::string>& definitions) {
    SceneVariables variables;
    for (const std::string& d : definitions) {
        const std::size_t equals = d.find('=');
        if (equals == std::string::npos || equals == 0)
            throw BadInput(fmt::format("-D {}: must be name=value", d));
        variables[d.substr(0, equals)] = d.substr(equals + 1);
    }
    return variables;
}

namespace {

/// Parses comma-separated ids of the choices of an enum.
template <class Enum>
std::vector<Enum> parse_list(const std::string& option, const std::string& text,
                             std::span<const SettingChoice> choices) {
    std::vector<Enum> values;
    for (const std::string& name : CLI::detail::split(text, ',')) {
        const auto found = std::ranges::find(choices, name, &SettingChoice::id);
        if (found == choices.end())
            throw BadInput(fmt::format("{} {}: must be one of {}", option, name, ids_of(choices)));
        values.push_back(static_cast<Enum>(found - choices.begin()));
    }
    return values;
}

} // namespace

std::vector<Norm> parse_norms(const std::string& text) {
    return parse_list<Norm>("--recon", text, norm_choices());
}

void check_available(const std::vector<Norm>& norms) {
    if (std::ranges::find(norms, Norm::oidn) != norms.end() && !oidn_problem().empty())
        throw BadInput("--recon oidn: " + oidn_problem());
}

std::vector<Method> parse_methods(const std::string& text) {
    return parse_list<Method>("-m", text, method_choices());
}

SampleChoice parse_sample(const std::string& option, const std::string& text) {
    const char *at = text.data(), *const end = at + text.size();
    int numbers[3] = {};
    for (int i = 0; i < 3; ++i) {
        const auto [rest, error] = std::from_chars(at, end, numbers[i]); // fails on overflow
        const bool ends_well = i == 2 ? rest == end : rest != end && *rest == ',';
        if (error != std::errc() || numbers[i] < 0 || !ends_well)
            throw BadInput(fmt::format("{} {}: must be X,Y,PASS, such as 120,45,0", option, text));
        at = rest + 1;
    }
    return {0, {numbers[0], numbers[1]}, numbers[2]};
}

CLI::Option* limit(CLI::Option* option, double least, double most) {
    const std::string range = fmt::format("from {:g} to {:g}", least, most);
    return option->check(
        [=](const std::string& text) {
            const std::optional<double> number = parse_number(text);
            return number && *number >= least && *number <= most
                       ? std::string()
                       : fmt::format("\"{}\" must be a number {}", text, range);
        },
        range);
}

CLI::Option* forbid_empty(CLI::Option* option) {
    return option->check(
        [](const std::string& text) { return text.empty() ? "the name is empty" : std::string(); }, "");
}

CLI::Option* limit_to_seconds(CLI::Option* option) {
    return limit(option, 1e-3, most_seconds);
}

CLI::Option* add_strict(CLI::App& command, bool& strict) {
    return command.add_flag("--strict", strict,
                            "fail if a mesh, texture, normal or transform is missing or damaged, instead of "
                            "replacing it");
}

namespace {

/// Returns the option of a setting: "--rr-delta" for "rr_delta".
std::string option_name(const Setting& setting) {
    std::string name = "--" + std::string(setting.id);
    std::ranges::replace(name, '_', '-');
    return name;
}

/// Adds an option called `name` that takes the id of one of the setting's choices.
CLI::Option* add_choice(CLI::App& command, const std::string& name, const Setting& setting) {
    std::vector<std::string> words;
    for (const SettingChoice& choice : std::get<Setting::OneOf>(setting.kind).choices)
        words.emplace_back(choice.id);
    return command
        .add_option_function<std::string>(
            name, [setting](const std::string& word) { setting.set_text(word); }, std::string(setting.help))
        ->check(CLI::IsMember(words));
}

/// Adds the option for a setting of any kind.
struct OptionAdder {
    CLI::App& command;
    const Setting& setting;
    std::string name = option_name(setting), help{setting.help};

    /// Integers, numbers and seconds, which have limits.
    CLI::Option* operator()(const auto& number) const {
        return limit(command.add_option(name, *number.value, help), number.least, number.most);
    }
    CLI::Option* operator()(const Setting::Natural& natural) const {
        return command.add_option(name, *natural.value, help)
            ->check(
                [](const std::string& text) { // CLI11 wraps -1 and 2^64
                    std::uint64_t value = 0;
                    const char* const end = text.data() + text.size();
                    const auto [rest, error] = std::from_chars(text.data(), end, value);
                    return error == std::errc() && rest == end
                               ? std::string()
                               : fmt::format("\"{}\" must be a whole number from 0 to 2^64 - 1", text);
                },
                "from 0");
    }
    CLI::Option* operator()(const Setting::Switch& on) const {
        return command.add_flag(name + ",!--no-" + name.substr(2), *on.value, help);
    }
    CLI::Option* operator()(const Setting::OneOf&) const { return add_choice(command, name, setting); }
    CLI::Option* operator()(const Setting::Size& size) const {
        return command.add_option_function<std::string>(
            name, [name = name, size](const std::string& text) { *size.value = parse_size(name, text); }, help);
    }
};

} // namespace

CLI::Option* add_setting(CLI::App& command, const Setting& setting) {
    return std::visit(OptionAdder{command, setting}, setting.kind)->default_str(setting.text());
}

void add_view_options(CLI::App& command, ViewArguments words) {
    command.add_option("--camera", words.camera, "JSON file with a camera, as saved in the viewer");
    forbid_empty(command.add_option("--sensor", words.sensor,
                                    "number of a sensor of the scene, from 0, or its id (default: the first)"));
    forbid_empty(command.add_option(
        "--crop", words.crop,
        "X,Y,WIDTHxHEIGHT: renders this window of the film, with the random numbers of the whole film (pixels); "
        "or none: the whole film (default: the sensor's crop window). --size is then the size of the film"));
}

CLI::Option* add_pixel_format(CLI::App& command, std::optional<PixelFormat>& format) {
    const std::vector<std::string> names{"luminance", "luminance_alpha", "rgb", "rgba", "xyz", "xyza"};
    return command
        .add_option_function<std::string>(
            "--pixel-format", [&format](const std::string& name) { format = pixel_format_from_name(name); },
            "channels of the picture. Alpha is the covered fraction of each pixel; colours are multiplied by it, "
            "except in PNG (default: the sensor's)")
        ->check(CLI::IsMember(names));
}

CLI::Option* add_method(CLI::App& command, Method& method) {
    const Setting setting = method_setting(method);
    return add_choice(command, "-m,--method", setting)->default_str(setting.text());
}

CLI::Option* add_methods(CLI::App& command, std::string& methods, const std::string& rest) {
    return command.add_option("-m,--method,--methods", methods,
                              fmt::format("{} {}", ids_of(method_choices()), rest));
}

CLI::Option* add_norm(CLI::App& command, ReconstructionSettings& settings) {
    const Setting setting = setting_named(settings_of(settings), "norm");
    return add_choice(command, "--recon", setting)->default_str(setting.text());
}

CLI::Option* add_norms(CLI::App& command, std::string& norms, const std::string& rest) {
    return command.add_option("--recon", norms, fmt::format("{} {}", ids_of(norm_choices()), rest));
}

CLI::Option* add_alpha(CLI::App& command, ReconstructionSettings& settings) {
    return add_setting(command, setting_named(settings_of(settings), "alpha"));
}

CLI::Option* add_clock(CLI::App& command, std::string& clock) {
    return command.add_option("--clock", clock, "the time that --time limits: cpu or wall")
        ->check(CLI::IsMember({"wall", "cpu"}))
        ->capture_default_str();
}

std::string option_words(RenderSettings from, RenderSettings to) {
    std::string words;
    const std::vector<Setting> before = settings_of(from), after = settings_of(to);
    for (std::size_t i = 0; i < after.size(); ++i) {
        const std::string name = option_name(after[i]), value = after[i].text();
        if (value == before[i].text())
            continue;
        if (std::holds_alternative<Setting::Switch>(after[i].kind))
            words += (value == "on" ? " " : " --no-") + name.substr(value == "on" ? 0 : 2);
        else
            words += " " + name + " " + value;
    }
    return words;
}

std::vector<std::string> render_option_names() {
    RenderSettings settings;
    std::vector<std::string> names;
    for (const Setting& setting : settings_of(settings))
        names.push_back(option_name(setting));
    return names;
}

void add_picture_options(CLI::App& command, PictureArguments words) {
    add_setting(command, size_setting(words.size))->default_str("the scene's");
    for (const Setting& setting : settings_of(words.settings))
        add_setting(command, setting);
    command.get_option("--max-depth")->default_str("the scene's");
    add_setting(command, seed_setting(words.settings.seed));
    add_setting(command, threads_setting(words.threads));
}

} // namespace tessera
