#pragma once

#include "ui/state/document.h"

#include <span>
#include <string>

namespace tessera {

/// What tells a picture with these settings from the others: "tile 6, L1". Only what makes a difference to both
/// counts: a tile does not tell PT from G-PR. Empty: nothing does but the method, if that.
std::string differences(const PaneSettings& settings, std::span<const PaneSettings> others);

/// "G-PR", or as much more as tells it from the others: "G-PR, tile 6, L1".
std::string picture_label(const PaneSettings& settings, std::span<const PaneSettings> others);

/// The label of a pane's picture among those of all panes.
std::string pane_label(const Document& document, int pane);

} // namespace tessera
