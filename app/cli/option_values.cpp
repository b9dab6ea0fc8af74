#include "app/cli/option_values.h"

#include "app/cli/terminal.h"
#include "render/estimator/settings_table.h"
#include "render/io/files.h"
#include "ui/state/inspected.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <CLI/StringTools.hpp>
#include <fmt/core.h>

namespace tessera {

glm::ivec2 parse_size(const std::string& option, const std::string& text) {
    int w = 0, h = 0, used = 0;
    if (std::sscanf(text.c_str(), "%dx%d%n", &w, &h, &used) != 2 || used != static_cast<int>(text.size()))
        throw BadInput(fmt::format("{} {}: must be WIDTHxHEIGHT, such as 640x360", option, text));
    try {
        check_image_size(w, h);
    } catch (const std::runtime_error& error) {
        throw BadInput(fmt::format("{} {}: {}", option, text, error.what()));
    }
    return {w, h};
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

/// Values with commas between them, each by `from_name`, which returns an optional.
template <class FromName>
auto parse_list(const std::string& option, const std::string& text, const char* known, FromName from_name) {
    std::vector<typename decltype(from_name({}))::value_type> values;
    for (const std::string& name : CLI::detail::split(text, ',')) {
        const auto value = from_name(name);
        if (!value)
            throw BadInput(fmt::format("{} {}: must be of {}", option, name, known));
        values.push_back(*value);
    }
    return values;
}

} // namespace

std::vector<Norm> parse_norms(const std::string& text) {
    return parse_list("--recon", text, "none, l2, l1, mixed, uniform, weighted", norm_from_name);
}

std::vector<Method> parse_methods(const std::string& text) {
    return parse_list("-m", text, "pt, pr, gpt, gpr", method_from_name);
}

SampleChoice parse_sample(const std::string& option, const std::string& text) {
    const char *at = text.data(), *const end = at + text.size();
    int numbers[3] = {};
    for (int i = 0; i < 3; ++i) {
        const auto [rest, error] = std::from_chars(at, end, numbers[i]); // refuses what an int cannot hold
        const bool ends_well = i == 2 ? rest == end : rest != end && *rest == ',';
        if (error != std::errc() || numbers[i] < 0 || !ends_well)
            throw BadInput(fmt::format("{} {}: must be X,Y,PASS, such as 120,45,0", option, text));
        at = rest + 1;
    }
    return {0, {numbers[0], numbers[1]}, numbers[2]};
}

namespace {

/// --rr-delta for "rr_delta".
std::string option_name(const Setting& setting) {
    std::string name = "--" + std::string(setting.id);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

void add_choice(CLI::App& command, const Setting& setting, const Setting::OneOf& one, RenderSettings& s) {
    std::vector<std::string> words;
    for (const SettingChoice& choice : one.choices)
        words.emplace_back(choice.id);
    command
        .add_option_function<std::string>(
            option_name(setting), [&setting, &s](const std::string& word) { setting.set_text(s, word); },
            std::string(setting.help))
        ->check(CLI::IsMember(words))
        ->default_str(setting.text(s));
}

/// The setting as an option. `s` must outlive the command.
void add_setting(CLI::App& command, const Setting& setting, RenderSettings& s) {
    const std::string name = option_name(setting), help(setting.help);
    CLI::Option* option = nullptr;
    if (const auto* whole = std::get_if<Setting::Whole>(&setting.kind))
        option = command.add_option(name, s.*whole->member, help)->check(CLI::Range(whole->least, whole->most));
    else if (const auto* real = std::get_if<Setting::Real>(&setting.kind))
        option = command.add_option(name, s.*real->member, help)->check(CLI::Range(real->least, real->most));
    else if (const auto* on = std::get_if<Setting::Switch>(&setting.kind))
        option = command.add_flag(name + ",!--no-" + name.substr(2), s.*on->member, help);
    else
        return add_choice(command, setting, std::get<Setting::OneOf>(setting.kind), s);
    option->default_str(setting.id == "max_depth" ? "the scene's" : setting.text(s));
}

} // namespace

void add_setting_options(CLI::App& command, RenderSettings& settings) {
    for (const Setting& setting : all_settings())
        add_setting(command, setting, settings);
}

std::string option_words(const RenderSettings& from, const RenderSettings& to) {
    std::string words;
    for (const Setting& setting : all_settings()) {
        const std::string name = option_name(setting), value = setting.text(to);
        if (value == setting.text(from))
            continue;
        if (std::holds_alternative<Setting::Switch>(setting.kind))
            words += (value == "on" ? " " : " --no-") + name.substr(value == "on" ? 0 : 2);
        else
            words += " " + name + " " + value;
    }
    return words;
}

void add_picture_options(CLI::App& command, PictureWords words) {
    command.add_option("--size", words.size, "WIDTHxHEIGHT of the image, pixels (default: the scene's)");
    add_setting_options(command, words.settings);
    command.add_option("--alpha", words.alpha, "weight of the primal against the gradients")
        ->check(CLI::Range(1e-4, 1e3))
        ->capture_default_str();
    command.add_option("--seed", words.settings.seed, "of the random numbers")->capture_default_str();
    command.add_option("--threads", words.threads, "0: one a hardware thread")->check(CLI::Range(0, 1024));
}

} // namespace tessera
