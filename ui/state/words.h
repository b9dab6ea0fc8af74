#pragma once

#include "render/settings/setting.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace tessera {

/// Names of enum values in settings files, scripts, log and lists, in the order of each enum.
namespace words {

/// SaveKind.
inline constexpr SettingChoice saved[] = {
    {"picture", "Picture, PNG", "The active pane's buffer, pixel by pixel, in the displayed colours."},
    {"exr", "Picture with all buffers, EXR",
     "The active pane's buffers, with first hits, errors, camera and settings."},
    {"window", "Window, PNG", "The whole window."},
    {"charts", "Charts, CSV with SVG and PNG",
     "The current chart as a picture, and all points and the histogram as CSV."},
    {"settings", "Settings, JSON", "Panes, camera, size, display and the inspected sample."},
    {"camera", "Camera, JSON", "The camera. The option --camera reads it, and it can be dropped on the window."},
};
/// SizeChoice::Base.
inline constexpr SettingChoice sizes[] = {
    {"pane", "fit the pane", "The pixels of the pane, in the proportions of the scene's film."},
    {"scene", "as in scene file", "The film size of the scene file."},
    {"custom", "custom", "The width and height given below."},
};
/// Tone::Curve.
inline constexpr SettingChoice tones[] = {
    {"srgb", "sRGB", "The display's curve: radiance from 0 to 1 is shown, larger values are clipped."},
    {"filmic", "filmic", "Compresses highlights instead of clipping them [Narkowicz 2015], then sRGB."},
};
/// Comparison::Kind.
inline constexpr SettingChoice comparisons[] = {
    {"off", "off", "The pane shows its own picture."},
    {"wipe", "wipe", "Its own picture is left of a line, another pane's right of it. Drag the line (V)."},
    {"difference", "difference", "Its own picture minus another pane's: orange above zero, blue below (N)."},
};
/// Pace::Equal.
inline constexpr SettingChoice shares[] = {
    {"time", "equal time", "The next pass goes to the pane with the shortest render time."},
    {"spp", "equal samples", "The next pass goes to the pane with the fewest samples per pixel."},
};
/// ChartKind.
inline constexpr SettingChoice charts[] = {
    {"error", "Error", "relMSE of each pane's picture against the reference."},
    {"efficiency", "Efficiency", "1 / (relMSE x seconds) of each pane: higher is better."},
    {"shifts", "Shifts", "Outcomes of each pane's shifts: the fraction that succeeded, and why others failed."},
};
/// Layout::charts_by_spp, false and true.
inline constexpr SettingChoice chart_axes[] = {
    {"seconds", "against seconds", "Wall time of a pane's own passes."},
    {"spp", "against samples", "Samples per pixel."},
};
/// Inspector::Direction.
inline constexpr SettingChoice directions[] = {
    {"to_pixel", "shifts to the pixel", "Base paths of other pixels of its sampling set, shifted to the pixel."},
    {"from_pixel", "shifts from the pixel", "The pixel's base path, shifted to the others of its sampling set."},
};
/// Theme.
inline constexpr SettingChoice themes[] = {{"dark", "", ""}, {"light", "", ""}};
} // namespace words

static_assert(std::size(words::chart_axes) == 2); // values of a bool

/// Returns the identifier of an enum's value.
template <class Enum, std::size_t count>
std::string_view word(const SettingChoice (&words)[count], Enum value) {
    return words[static_cast<std::size_t>(value)].id;
}

/// Returns the label of an identifier: "no light" for "no_light". The shift outcome "kind_mismatch" is shown as
/// "not connectable"; files keep its identifier.
inline std::string label_of_identifier(std::string_view name) {
    if (name == "kind_mismatch")
        return "not connectable";
    std::string text(name);
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

/// Closed interval of a setting's values.
struct Range {
    double least, most;

    float low() const { return static_cast<float>(least); }
    float high() const { return static_cast<float>(most); }
};

namespace ranges {
inline constexpr Range exposure{-10, 10}; ///< stops
inline constexpr Range scale{0.05, 2};    ///< of the rendered width and height
inline constexpr Range share{0, 1};
} // namespace ranges

} // namespace tessera
