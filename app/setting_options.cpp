#include "app/setting_options.h"

#include "render/method/settings_table.h"

#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace tessera {

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
