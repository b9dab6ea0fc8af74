#pragma once

#include "ui/state/document.h"

#include <span>
#include <string>

namespace tessera {

/// Returns the settings, apart from the method, that distinguish a picture from the others: "tile 6, L1". A
/// setting counts only if it affects both pictures. Empty: no such setting differs.
std::string differences(const PaneSettings& settings, std::span<const PaneSettings> others);

/// Returns the method and differences(): "G-PR, tile 6, L1".
std::string picture_label(const PaneSettings& settings, std::span<const PaneSettings> others);

/// Returns picture_label() of a pane among all panes.
std::string pane_label(const Document& document, int pane);

} // namespace tessera
