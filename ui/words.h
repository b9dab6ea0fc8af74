#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace tessera {

/// What settings files, scripts and the log call the values of enums, in their order.
namespace words {
inline constexpr const char* off_on[] = {"off", "on"};
inline constexpr const char* sizes[] = {"pane", "scene", "custom"};         // SizeChoice::Base
inline constexpr const char* tones[] = {"srgb", "gamma", "filmic"};         // Tone::Curve
inline constexpr const char* comparisons[] = {"off", "wipe", "difference"}; // Comparison::Kind
inline constexpr const char* shares[] = {"time", "spp"};                    // Pace::Equal
inline constexpr const char* charts[] = {"error", "efficiency", "shifts"};  // ChartKind
inline constexpr const char* chart_axes[] = {"seconds", "spp"};             // ViewerState::charts_by_spp
inline constexpr const char* themes[] = {"dark", "light"};                  // Theme
inline constexpr const char* directions[] = {"to_pixel", "from_pixel"};     // Inspector::Direction
} // namespace words

template <class Enum, std::size_t count>
const char* word(const char* const (&words)[count], Enum value) {
    return words[static_cast<std::size_t>(value)];
}

/// "kind_mismatch" as it is written in prose.
inline std::string in_words(std::string_view name) {
    std::string text(name);
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

/// Where a setting may lie, whoever sets it.
struct Range {
    double least, most;

    float low() const { return static_cast<float>(least); }
    float high() const { return static_cast<float>(most); }
};

namespace ranges {
inline constexpr int most_spp = 1 << 24;
inline constexpr double most_seconds = 1e7;
inline constexpr Range alpha{1e-4, 1e3}, alpha_slider{0.001, 10}, exposure{-10, 10}, gamma{1, 4},
    spp_limit{0, most_spp}, reference_spp{2, most_spp}, seconds_limit{0, most_seconds};
} // namespace ranges

} // namespace tessera
