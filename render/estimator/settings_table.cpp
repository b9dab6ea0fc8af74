#include "render/estimator/settings_table.h"

#include "render/estimator/settings.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include <fmt/core.h>

namespace tessera {

namespace {

struct Names {
    Method method;
    std::string_view short_name;
    std::string_view long_name;
};

constexpr Names names[] = {
    {Method::pt, "pt", "Path tracing"},
    {Method::pr, "pr", "Path reusing"},
    {Method::gpt, "gpt", "Gradient-domain path tracing"},
    {Method::gpr, "gpr", "Gradient-domain path reusing"},
};

} // namespace

std::string_view short_name(Method method) {
    return names[static_cast<int>(method)].short_name;
}
std::string_view long_name(Method method) {
    return names[static_cast<int>(method)].long_name;
}

std::optional<Method> method_from_name(std::string_view short_name) {
    for (const Names& n : names)
        if (n.short_name == short_name)
            return n.method;
    return {};
}

namespace {

template <auto member>
Setting::OneOf one_of(std::span<const SettingChoice> choices) {
    return {choices, [](const RenderSettings& s) { return static_cast<int>(s.*member); },
            [](RenderSettings& s, int value) {
                s.*member = static_cast<std::remove_reference_t<decltype(s.*member)>>(value);
            }};
}

constexpr SettingChoice patterns[] = {
    {"tile", "square tile", "All pixels of a square share their paths."},
    {"rooks", "N-rooks",
     "N pixels on an N x N square share their paths, one in each row and column, so that nothing "
     "repeats from a pixel to its neighbour [Bekaert 2002]. PR only."},
};
constexpr SettingChoice shifts[] = {
    {"half-vector", "half vectors, reconnection",
     "Half vectors are copied until two rough vertices can be connected; mirrors and glass are reused, too "
     "[Kettunen 2015, Bauszat 2017]."},
    {"reconnection", "reconnection of x1 and x2",
     "The first hit of one pixel is joined to the second hit of another; direct light is each pixel's own "
     "[Bekaert 2002]."},
    {"replay", "random replay",
     "The other pixel's path takes the same random numbers, all the way [Hua 2019, 3.1]."},
    {"replay-reconnection", "replay, reconnection",
     "Random numbers are replayed until two rough vertices can be connected [Hua 2019, 3.1]."},
};
constexpr SettingChoice roulettes[] = {
    {"relative", "relative", "Against the noise of the tile: the unit of light does not matter."},
    {"absolute", "absolute", "Against RR delta, a radiance [Bauszat 2017, 3.3]."},
    {"none", "none", "Every path is reused."},
};
constexpr SettingChoice primals[] = {
    {"reuse", "shared paths", "What the pixels of a tile share out: less noise, the same for neighbours."},
    {"base", "base paths", "Each pixel's own path: as noisy as path tracing, but independent."},
};

bool always(const RenderSettings&) {
    return true;
}
bool shares(const RenderSettings& s) {
    return reuses_paths(s.method);
}
bool shifts_paths(const RenderSettings& s) {
    return s.method != Method::pt;
}
bool joins_paths(const RenderSettings& s) {
    return shifts_paths(s) && s.shift != ShiftKind::replay;
}
bool joins_long_edges(const RenderSettings& s) {
    return joins_paths(s) && s.shift != ShiftKind::reconnection;
}

const Setting table[] = {
    {"tile", "Tile",
     "Edge of a tile, in pixels. The pixels of a tile reuse each other's paths. Used by PR and G-PR.",
     Setting::Whole{&RenderSettings::tile, 1, most_tile}, shares},
    {"adapt_tile", "Adapt",
     "Cuts tiles into smaller ones where paths bring alike: there, many offsets cost more than they gain.",
     Setting::Switch{&RenderSettings::adapt_tile}, has_tiles_to_cut},
    {"jitter", "Jitter",
     "Moves the grid of tiles every pass, so that no pixel is always at a tile's edge. Off, edges stay in the "
     "picture.",
     Setting::Switch{&RenderSettings::jitter}, shares, true},
    {"pattern", "Pattern", "Which pixels share their paths.", one_of<&RenderSettings::pattern>(patterns),
     [](const RenderSettings& s) { return s.method == Method::pr; }},
    {"roulette", "Roulette", "How it is decided which base paths are reused.",
     one_of<&RenderSettings::roulette>(roulettes), shares},
    {"rr_scale", "RR scale",
     "Relative roulette: a path whose value is below this many standard deviations of the values in its tile is "
     "reused less often, in proportion (no unit).",
     Setting::Real{&RenderSettings::rr_scale, 0, 1000, 0, 100},
     [](const RenderSettings& s) { return shares(s) && s.roulette == RouletteKind::relative; }},
    {"rr_delta", "RR delta",
     "Absolute roulette: a path whose value (luminance, a radiance) is below delta is reused with probability "
     "value / "
     "delta. 0: every path is reused.",
     Setting::Real{&RenderSettings::rr_delta, 0, 1e30f, 0, 10},
     [](const RenderSettings& s) { return shares(s) && s.roulette == RouletteKind::absolute; }},
    {"q_min", "q min",
     "Least probability with which the roulette lets a path be reused (no unit). Above 0, since a path can bring "
     "far more light to a neighbour than to its own pixel.",
     Setting::Real{&RenderSettings::q_min, 1e-4f, 1, 0.001f, 1},
     [](const RenderSettings& s) { return shares(s) && s.roulette != RouletteKind::none; }},
    {"weight_threshold", "RR weight",
     "Roulette on small weights: a light path whose weight is below this share of the even one is shared out less "
     "often, in proportion (no unit) [Bekaert 2002]. 0: never.",
     Setting::Real{&RenderSettings::weight_threshold, 0, 1, 0, 1}, joins_paths, true},
    {"primal", "Primal", "Where G-PR has its primal image from.", one_of<&RenderSettings::primal>(primals),
     [](const RenderSettings& s) { return s.method == Method::gpr; }, true},
    {"shift", "Shift", "How a path is taken to another pixel.", one_of<&RenderSettings::shift>(shifts),
     shifts_paths},
    {"shift_threshold", "Roughness",
     "Shift threshold: roughness (alpha, no unit) above which a vertex can be connected to [Kettunen 2015].",
     Setting::Real{&RenderSettings::shift_threshold, 0, 1, 0, 1}, joins_paths, true},
    {"shift_distance", "Distance",
     "Shift distance: edges shorter than so many pixels are wide at the first hit are not joined, but bounced "
     "along: from other pixels, what is close in a corner looks quite different. 0: all are joined.",
     Setting::Real{&RenderSettings::shift_distance, 0, 1000, 0, 20}, joins_long_edges, true},
    {"max_depth", "Max depth", "Most edges of a light path. 1: only lamps seen directly; 2: and direct light.",
     Setting::Whole{&RenderSettings::max_depth, 1, most_edges}, always},
    {"light_samples", "Light samples", "Points on lights that are drawn at every vertex of a path.",
     Setting::Whole{&RenderSettings::light_samples, 1, 16}, always, true},
    {"very_direct_grid", "Lamp grid",
     "Where lamps that the camera sees have their edges, a sample looks for them with a grid of this many rays "
     "along "
     "each edge of the pixel. 1: with the ray of its path.",
     Setting::Whole{&RenderSettings::very_direct_grid, 1, 8}, always, true},
    {"roulette_depth", "RR depth",
     "Edges beyond which a path goes on with a probability that follows the reflectance it meets (at most 0.95). "
     "0: it goes on to the max depth.",
     Setting::Whole{&RenderSettings::roulette_depth, 0, most_edges}, always, true},
};

} // namespace

std::span<const Setting> all_settings() {
    return table;
}

const Setting& setting_named(std::string_view id) {
    std::string wanted(id), all;
    std::replace(wanted.begin(), wanted.end(), '-', '_');
    for (const Setting& setting : table) {
        if (setting.id == wanted)
            return setting;
        all += fmt::format("{}{}", all.empty() ? "" : ", ", setting.id);
    }
    throw std::invalid_argument(fmt::format("there is no setting \"{}\", only: {}", id, all));
}

std::string Setting::text(const RenderSettings& s) const {
    if (const auto* whole = std::get_if<Whole>(&kind))
        return fmt::format("{}", s.*whole->member);
    if (const auto* real = std::get_if<Real>(&kind))
        return fmt::format("{}", s.*real->member);
    if (const auto* on = std::get_if<Switch>(&kind))
        return s.*on->member ? "on" : "off";
    const OneOf& one = std::get<OneOf>(kind);
    return std::string(one.choices[static_cast<std::size_t>(one.get(s))].id);
}

std::string Setting::allowed() const {
    if (const auto* whole = std::get_if<Whole>(&kind))
        return fmt::format("a whole number from {} to {}", whole->least, whole->most);
    if (const auto* real = std::get_if<Real>(&kind))
        return fmt::format("a number from {:g} to {:g}", real->least, real->most);
    if (std::holds_alternative<Switch>(kind))
        return "on or off";
    std::string choices;
    for (const SettingChoice& choice : std::get<OneOf>(kind).choices)
        choices += fmt::format("{}{}", choices.empty() ? "one of " : ", ", choice.id);
    return choices;
}

void Setting::set_text(RenderSettings& s, std::string_view text) const {
    const auto refuse = [&] {
        throw std::invalid_argument(fmt::format("{} is \"{}\": must be {}", id, text, allowed()));
    };
    const auto number = [&](auto value, auto least, auto most) {
        const char* const end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc() || rest != end || !(value >= least && value <= most))
            refuse();
        return value;
    };
    if (const auto* whole = std::get_if<Whole>(&kind)) {
        s.*whole->member = number(0, whole->least, whole->most);
    } else if (const auto* real = std::get_if<Real>(&kind)) {
        s.*real->member = number(0.0f, real->least, real->most);
    } else if (const auto* on = std::get_if<Switch>(&kind)) {
        if (text != "on" && text != "off")
            refuse();
        s.*on->member = text == "on";
    } else {
        const OneOf& one = std::get<OneOf>(kind);
        const auto has_id = [&](const SettingChoice& choice) { return choice.id == text; };
        const auto found = std::find_if(one.choices.begin(), one.choices.end(), has_id);
        if (found == one.choices.end())
            refuse();
        one.set(s, static_cast<int>(found - one.choices.begin()));
    }
}

void check(const RenderSettings& s) {
    const auto check_range = [&s](const Setting& setting, auto value, auto least, auto most) {
        if (!(value >= least && value <= most))
            throw std::invalid_argument(
                fmt::format("{} is {}: must be {}", setting.id, setting.text(s), setting.allowed()));
    };
    for (const Setting& setting : table) {
        if (const auto* whole = std::get_if<Setting::Whole>(&setting.kind))
            check_range(setting, s.*whole->member, whole->least, whole->most);
        else if (const auto* real = std::get_if<Setting::Real>(&setting.kind))
            check_range(setting, s.*real->member, real->least, real->most);
    }
}

} // namespace tessera
