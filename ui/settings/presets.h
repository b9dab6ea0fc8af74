#pragma once

#include "ui/state/document.h"

#include <span>
#include <string_view>

namespace tessera {

/// Settings of a paper, or the program's defaults.
struct Preset {
    std::string_view id;
    std::string_view label;
    std::string_view help;
    PaneSettings (*settings)(); ///< returns render and reconstruction settings
};

/// Returns all presets; the defaults are the first.
std::span<const Preset> presets();

/// Sets the pane's render and reconstruction to the preset's. The pane keeps its method, seed, maximum depth,
/// buffer and comparison.
void apply(const Preset& preset, PaneSettings& pane);

/// Returns the index of the preset that the pane's settings equal, apart from those that apply() keeps; -1: none.
int preset_of(const PaneSettings& pane);

} // namespace tessera
