#pragma once

#include "ui/state/document.h"

#include <span>
#include <string_view>

namespace tessera {

/// Settings of a paper, or the program's own.
struct Preset {
    std::string_view id;
    std::string_view label;
    std::string_view help;
    PaneSettings (*settings)(); ///< render and reconstruction; apply() keeps some of the pane's own
};

/// Returns all presets; the program's own is the first.
std::span<const Preset> presets();

/// Sets the pane's render and reconstruction to the preset's. The pane keeps its method, seed, maximum depth,
/// light samples, buffer and comparison.
void apply(const Preset& preset, PaneSettings& pane);

/// Returns the index of the preset that apply() would not change the pane by; -1: none.
int preset_of(const PaneSettings& pane);

} // namespace tessera
