#pragma once

#include "render/settings/setting.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace tessera {

/// What settings files, scripts, the log and lists call the values of enums, in their order.
namespace words {

/// SaveKind.
inline constexpr SettingChoice saved[] = {
    {"picture", "Picture, PNG", "The active pane's buffer, pixel by pixel, in the colours on show."},
    {"exr", "Picture with all buffers, EXR", "The active pane's, with first hits, errors, camera and settings."},
    {"window", "Window, PNG", "What the window shows."},
    {"charts", "Charts, CSV with SVG and PNG", "The chart on show, and all points and the histogram."},
    {"settings", "Settings, JSON", "Panes, camera, size, display and what is inspected."},
    {"camera", "Camera, JSON", "To be read by --camera, or dropped on the window."},
};
/// The words of SizeChoice::Base.
inline constexpr SettingChoice sizes[] = {
    {"pane", "fit the pane", "As many pixels as the pane has, in the film's proportions."},
    {"scene", "of the scene", "The film size of the scene file."},
    {"custom", "custom", "The width and height given below."},
};
/// The words of Tone::Curve.
inline constexpr SettingChoice tones[] = {
    {"srgb", "sRGB", "The display's own curve: linear radiance up to 1, the rest is cut."},
    {"filmic", "filmic", "Highlights are compressed instead of cut [Narkowicz 2015], then sRGB."},
};
/// The words of Comparison::Kind.
inline constexpr SettingChoice comparisons[] = {
    {"off", "off", "The pane shows its own picture."},
    {"wipe", "wipe", "Its own picture to the left of a line, another pane's to the right. Drag the line (V)."},
    {"difference", "difference", "Its own picture minus another pane's: orange above zero, blue below (N)."},
};
/// The words of Pace::Equal.
inline constexpr SettingChoice shares[] = {
    {"time", "same time", "Passes go to the pane that has rendered for the shortest time."},
    {"spp", "same spp", "Passes go to the pane with the fewest samples a pixel."},
};
/// The words of ChartKind.
inline constexpr SettingChoice charts[] = {
    {"error", "Error", "relMSE of each pane's picture to the reference."},
    {"efficiency", "Efficiency", "1 / (relMSE x seconds) of each pane: higher is better."},
    {"shifts", "Shifts", "How the shifts of each pane ended: which share came through, and why others did not."},
};
/// The words of Layout::charts_by_spp.
inline constexpr SettingChoice chart_axes[] = {
    {"seconds", "against seconds", "Wall time of a pane's own passes."},
    {"spp", "against samples", "Samples a pixel."},
};
/// The words of Inspector::Direction.
inline constexpr SettingChoice directions[] = {
    {"to_pixel", "what reaches the pixel", "The base paths of its sampling set, shifted to the pixel."},
    {"from_pixel", "where its path goes", "The pixel's own base path, shifted to the others of its set."},
};
/// The words of Theme, which no panel lists.
inline constexpr SettingChoice themes[] = {{"dark", "", ""}, {"light", "", ""}};
} // namespace words

static_assert(std::size(words::chart_axes) == 2); // of a bool

/// The word of an enum's value, by its position in the list.
template <class Enum, std::size_t count>
std::string_view word(const SettingChoice (&words)[count], Enum value) {
    return words[static_cast<std::size_t>(value)].id;
}

/// "kind_mismatch" as it is written in prose.
inline std::string in_words(std::string_view name) {
    std::string text(name);
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

/// Where a number may lie, whoever sets it.
struct Range {
    double least, most;

    float low() const { return static_cast<float>(least); }
    float high() const { return static_cast<float>(most); }
};

namespace ranges {
inline constexpr Range exposure{-10, 10}; ///< stops
inline constexpr Range scale{0.05, 2};    ///< of the width and height of what is rendered
inline constexpr Range share{0, 1};
} // namespace ranges

} // namespace tessera
