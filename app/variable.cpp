#include "app/variable.h"

#include "app/option_values.h"
#include "render/method/settings_table.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

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

} // namespace tessera
