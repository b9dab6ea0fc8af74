#include "render/estimator/settings_table.h"
#include "ui/state/settings_file.h"
#include "ui/state/words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <span>
#include <stdexcept>

#include <fmt/core.h>

namespace tessera {

namespace {

double number(const std::string& name, const std::string& value, Range range) {
    const auto [least, most] = range;
    char* end = nullptr;
    const double result = std::strtod(value.c_str(), &end);
    if (value.empty() || *end != 0 || !(result >= least && result <= most))
        throw std::invalid_argument(name + " is a number from " + std::to_string(least) + " to " +
                                    std::to_string(most) + ", not " + value);
    return result;
}

/// The index of the word.
int one_of(const std::string& name, const std::string& value, std::span<const char* const> words) {
    const auto found = std::find(words.begin(), words.end(), value);
    if (found != words.end())
        return static_cast<int>(found - words.begin());
    std::string list;
    for (const char* word : words)
        list += std::string(list.empty() ? "" : ", ") + word;
    throw std::invalid_argument(name + " is one of " + list + ", not " + value);
}

Method method_named(const std::string& value) {
    if (const auto method = method_from_name(value))
        return *method;
    throw std::invalid_argument("method is one of pt, pr, gpt, gpr, not " + value);
}

Norm norm_named(const std::string& value) {
    if (const auto norm = norm_from_name(value))
        return *norm;
    std::string list;
    for (Norm norm : all_norms)
        list += fmt::format("{}{}", list.empty() ? "" : ", ", to_string(norm));
    throw std::invalid_argument("norm is one of " + list + ", not " + value);
}

glm::ivec2 size_of(const std::string& value) {
    glm::ivec2 size(0);
    char rest = 0;
    if (std::sscanf(value.c_str(), "%dx%d%c", &size.x, &size.y, &rest) != 2 || size.x < 1 || size.y < 1 ||
        std::max(size.x, size.y) > most_render_pixels_an_edge)
        throw std::invalid_argument("size is WIDTHxHEIGHT in pixels, not " + value);
    return size;
}

std::uint64_t seed_of(const std::string& name, const std::string& value) {
    std::uint64_t seed = 0;
    const char* const end = value.data() + value.size();
    if (const auto [rest, error] = std::from_chars(value.data(), end, seed); error != std::errc() || rest != end)
        throw std::invalid_argument(name + " is a whole number from 0, not " + value);
    return seed;
}

struct Named {
    const char* name;
    void (*set)(ViewerState&, const std::string& name, const std::string& value);
};

using S = ViewerState;
using Text = const std::string&;

/// Sets the bool that `of` picks.
template <auto of>
void flag(S& s, Text name, Text value) {
    of(s) = one_of(name, value, words::off_on) == 1;
}

constexpr Named table[] = {
    {"method", [](S& s, Text, Text v) { s.active().settings.render.method = method_named(v); }},
    {"seed",
     [](S& s, Text n, Text v) {
         s.active().settings.render.seed = seed_of(n, v);
         s.share_settings();
     }},
    {"buffer", [](S& s, Text, Text v) { s.active().settings.buffer = buffer_named(v); }},
    {"comparison",
     [](S& s, Text n, Text v) {
         s.active().settings.comparison.kind = static_cast<Comparison::Kind>(one_of(n, v, words::comparisons));
     }},
    {"compare_with",
     [](S& s, Text n, Text v) {
         s.active().settings.comparison.with =
             v == "reference" ? the_reference : static_cast<int>(number(n, v, {1, most_panes})) - 1;
     }},
    {"active",
     [](S& s, Text n, Text v) {
         s.active_pane = static_cast<int>(number(n, v, {1, static_cast<double>(s.panes.size())})) - 1;
     }},
    {"panes",
     [](S& s, Text n, Text v) {
         s.set_pane_count(static_cast<int>(number(n, v, {1, most_panes})));
     }},
    {"alone", flag<[](S& s) -> bool& { return s.layout.alone; }>},
    {"wipe",
     [](S& s, Text n, Text v) {
         s.layout.wipe = static_cast<float>(number(n, v, {0, 1}));
     }},
    {"linked", flag<[](S& s) -> bool& { return s.linked; }>},
    {"paused", flag<[](S& s) -> bool& { return s.paused; }>},
    {"spp_limit",
     [](S& s, Text n, Text v) { s.pace.spp_limit = static_cast<int>(number(n, v, ranges::spp_limit)); }},
    {"seconds_limit", [](S& s, Text n, Text v) { s.pace.seconds_limit = number(n, v, ranges::seconds_limit); }},
    {"equal", [](S& s, Text n, Text v) { s.pace.equal = static_cast<Pace::Equal>(one_of(n, v, words::shares)); }},
    {"size",
     [](S& s, Text, Text v) {
         s.size = {SizeChoice::Base::custom, 1, size_of(v)};
     }},
    {"exposure",
     [](S& s, Text n, Text v) { s.tone.exposure = static_cast<float>(number(n, v, ranges::exposure)); }},
    {"gamma", [](S& s, Text n, Text v) { s.tone.gamma = static_cast<float>(number(n, v, ranges::gamma)); }},
    {"tone", [](S& s, Text n, Text v) { s.tone.curve = static_cast<Tone::Curve>(one_of(n, v, words::tones)); }},
    {"magnifier", flag<[](S& s) -> bool& { return s.magnifier; }>},
    {"tiles", flag<[](S& s) -> bool& { return s.show_tiles; }>},
    {"inspector", [](S& s, Text n, Text v) { s.set_inspector(one_of(n, v, words::off_on) == 1); }},
    {"slow_motion", [](S& s, Text n, Text v) { s.set_slow_motion(one_of(n, v, words::off_on) == 1); }},
    {"slow_motion_held", flag<[](S& s) -> bool& { return s.slow_motion.held; }>},
    {"slow_motion_speed",
     [](S& s, Text n, Text v) {
         s.slow_motion.speed =
             static_cast<float>(number(n, v, {double{SlowMotion::least_speed}, double{SlowMotion::most_speed}}));
     }},
    {"inspector_shows",
     [](S& s, Text n, Text v) {
         s.inspector.direction = static_cast<Inspector::Direction>(one_of(n, v, words::directions));
     }},
    {"mark_negative", flag<[](S& s) -> bool& { return s.mark_negative; }>},
    {"theme", [](S& s, Text n, Text v) { s.layout.theme = static_cast<Theme>(one_of(n, v, words::themes)); }},
    {"ui_scale",
     [](S& s, Text n, Text v) {
         s.layout.set_ui_scale(static_cast<float>(number(n, v, {1, 3})));
     }},
    {"panel", flag<[](S& s) -> bool& { return s.layout.show_panel; }>},
    {"statistics", flag<[](S& s) -> bool& { return s.layout.show_statistics; }>},
    {"charts", flag<[](S& s) -> bool& { return s.layout.show_charts; }>},
    {"chart", [](S& s, Text n, Text v) { s.layout.chart_kind = static_cast<ChartKind>(one_of(n, v, words::charts)); }},
    {"large_charts", flag<[](S& s) -> bool& { return s.layout.large_charts; }>},
    {"reference_spp",
     [](S& s, Text n, Text v) { s.reference_making.spp = static_cast<int>(number(n, v, ranges::reference_spp)); }},
    {"reference_method", [](S& s, Text, Text v) { s.reference_making.method = method_named(v); }},
    {"charts_axis", [](S& s, Text n, Text v) { s.layout.charts_by_spp = one_of(n, v, words::chart_axes) == 1; }},
    {"alpha",
     [](S& s, Text n, Text v) {
         s.active().settings.reconstruction.alpha = static_cast<float>(number(n, v, ranges::alpha));
         s.share_settings();
     }},
    {"norm",
     [](S& s, Text, Text v) {
         s.active().settings.reconstruction.norm = norm_named(v);
         s.share_settings();
     }},
};

} // namespace

Buffer buffer_named(const std::string& value) {
    for (Buffer buffer : all_buffers) {
        if (short_name(buffer) == value)
            return buffer;
    }
    if (value == "failed") // as older settings files call it
        return Buffer::outcomes;
    throw std::invalid_argument("no buffer is called " + value);
}

void set_by_name(ViewerState& state, const std::string& name, const std::string& value) {
    const auto named =
        std::find_if(std::begin(table), std::end(table), [&](const Named& n) { return name == n.name; });
    if (named != std::end(table))
        return named->set(state, name, value);
    for (const Setting& setting : all_settings()) {
        if (setting.id != name)
            continue;
        setting.set_text(state.active().settings.render, value);
        return state.share_settings();
    }
    std::string list;
    for (const Named& n : table)
        list += std::string(n.name) + ", ";
    for (const Setting& setting : all_settings())
        list += std::string(setting.id) + (&setting == &all_settings().back() ? "" : ", ");
    throw std::invalid_argument("nothing is called " + name + "; there are " + list);
}

} // namespace tessera
