#pragma once

#include "ui/state/document.h"

#include <span>
#include <string_view>

namespace tessera {

/// Settings that belong together: those of a paper, or the program's own.
struct Preset {
    std::string_view id;
    std::string_view label;
    std::string_view help;
    PaneSettings (*settings)(); ///< render (without what the pane keeps) and reconstruction
};

/// All presets; the program's own is the first.
std::span<const Preset> presets();

/// Gives a pane the settings of the preset. The pane keeps its method, depth, seed, buffer and comparison.
void apply(const Preset& preset, PaneSettings& pane);

/// The preset that the pane's settings are those of, whatever it keeps of its own; -1: none.
int preset_of(const PaneSettings& pane);

} // namespace tessera
