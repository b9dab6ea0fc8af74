#include "app/experiment/setup.h"

#include "app/cli/option_values.h"
#include "app/cli/terminal.h"
#include "render/estimator/settings_table.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <system_error>

#include <fmt/core.h>

namespace tessera {

namespace {

std::optional<double> number_of(const Setting& setting, const RenderSettings& settings) {
    if (const auto* whole = std::get_if<Setting::Whole>(&setting.kind))
        return settings.*whole->member;
    if (const auto* real = std::get_if<Setting::Real>(&setting.kind))
        return settings.*real->member;
    return {};
}

Variable variable_of(const Setting& setting) {
    return {std::string(setting.id),
            std::string(setting.label),
            [&setting](const PictureSettings& s) { return setting.text(s.render); },
            [&setting](PictureSettings& s, std::string_view text) { setting.set_text(s.render, text); },
            [&setting](const PictureSettings& s) { return setting.matters(s.render); },
            [&setting](const PictureSettings& s) { return number_of(setting, s.render); }};
}

template <class Number>
Number parse_number(const char* id, std::string_view text, Number least, Number most) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end || !(value >= least && value <= most))
        throw std::invalid_argument(fmt::format("{} is \"{}\": must be a number from {:g} to {:g}", id, text,
                                                double(least), double(most)));
    return value;
}

Norm parse_norm(std::string_view text) {
    const std::optional<Norm> norm = norm_from_name(text);
    if (!norm)
        throw std::invalid_argument(
            fmt::format("recon is \"{}\": must be one of none, l2, l1, mixed, uniform, weighted", text));
    return *norm;
}

bool has_gradients(const PictureSettings& s) {
    return has_gradients(s.render.method);
}
bool always(const PictureSettings&) {
    return true;
}

/// What the table of render settings does not have.
std::vector<Variable> other_variables() {
    using S = PictureSettings;
    return {
        {"recon", "Reconstruction", [](const S& s) { return std::string(to_string(s.reconstruction.norm)); },
         [](S& s, std::string_view text) { s.reconstruction.norm = parse_norm(text); }, has_gradients,
         [](const S&) { return std::optional<double>(); }},
        {"alpha", "Alpha", [](const S& s) { return fmt::format("{:.6g}", s.reconstruction.alpha); },
         [](S& s, std::string_view text) { s.reconstruction.alpha = parse_number("alpha", text, 1e-4f, 1e3f); },
         [](const S& s) { return has_gradients(s) && s.reconstruction.norm != Norm::none; },
         [](const S& s) { return std::optional<double>(s.reconstruction.alpha); }},
        {"size", "Size, pixels", [](const S& s) { return fmt::format("{}x{}", s.size.x, s.size.y); },
         [](S& s, std::string_view text) { s.size = parse_size("size", std::string(text)); }, always,
         [](const S& s) { return std::optional<double>(double(s.size.x) * s.size.y); }},
        {"threads", "Threads", [](const S& s) { return fmt::format("{}", s.threads); },
         [](S& s, std::string_view text) { s.threads = parse_number("threads", text, 1, 1024); }, always,
         [](const S& s) { return std::optional<double>(s.threads); }},
    };
}

} // namespace

Variable variable_named(std::string_view id) {
    const std::vector<Variable> others = other_variables();
    for (const Variable& variable : others)
        if (variable.id == id)
            return variable;
    try {
        return variable_of(setting_named(id));
    } catch (const std::invalid_argument& error) {
        std::string all = error.what();
        for (const Variable& variable : others)
            all += ", " + variable.id;
        throw std::invalid_argument(all);
    }
}

namespace {

/// The value as the setting itself spells it: "0.10" is "0.1".
std::string spelled(const Variable& variable, std::string_view value) {
    PictureSettings settings;
    variable.set_text(settings, value);
    return variable.text(settings);
}

/// Every setting in turn, each time with all values of the variation.
std::vector<PictureSettings> varied(const std::vector<PictureSettings>& all, const Variation& variation) {
    std::vector<PictureSettings> result;
    for (PictureSettings settings : all) {
        for (const std::string& value : variation.values) {
            variation.variable.set_text(settings, value);
            result.push_back(settings);
        }
    }
    return result;
}

/// Without gradients there is nothing to reconstruct from: all settings of that are one.
PictureSettings plain(PictureSettings settings) {
    if (!has_gradients(settings.render.method))
        settings.reconstruction = {.norm = Norm::none};
    return settings;
}

} // namespace

Variation parse_variation(std::string_view text) {
    try {
        const std::size_t equals = text.find('=');
        if (equals == text.npos)
            throw std::invalid_argument("must be SETTING=VALUE,VALUE,... such as tile=2,4,8");
        Variation variation{variable_named(text.substr(0, equals)), {}};
        std::string_view rest = text.substr(equals + 1);
        for (bool more = true; more;) {
            const std::size_t comma = rest.find(',');
            variation.values.push_back(spelled(variation.variable, rest.substr(0, comma)));
            more = comma != rest.npos;
            rest.remove_prefix(more ? comma + 1 : rest.size());
        }
        return variation;
    } catch (const std::runtime_error& error) {
        throw BadInput(fmt::format("--vary {}: {}", text, error.what()));
    } catch (const std::invalid_argument& error) {
        throw BadInput(fmt::format("--vary {}: {}", text, error.what()));
    }
}

std::vector<Setup> setups_of(const PictureSettings& base, const std::vector<Method>& methods,
                             const std::vector<Norm>& norms, const std::vector<Variation>& variations) {
    std::vector<PictureSettings> all;
    for (Method method : methods) {
        for (Norm norm : norms) {
            all.push_back(base);
            all.back().render.method = method;
            all.back().reconstruction.norm = norm;
        }
    }
    for (const Variation& variation : variations)
        all = varied(all, variation);

    std::vector<Setup> setups;
    for (const PictureSettings& settings : all) {
        Setup setup{plain(settings), {}};
        for (const Variation& v : variations)
            setup.values.push_back(v.variable.matters(settings) ? v.variable.text(settings) : "");
        const auto is_same = [&](const Setup& p) {
            return name_of(p) == name_of(setup) && p.values == setup.values;
        };
        if (std::none_of(setups.begin(), setups.end(), is_same))
            setups.push_back(setup);
    }
    return setups;
}

std::string name_of(const Setup& setup) {
    std::string name(short_name(setup.settings.render.method));
    if (has_gradients(setup.settings.render.method))
        name += fmt::format("-{}", to_string(setup.settings.reconstruction.norm));
    return name;
}

} // namespace tessera
