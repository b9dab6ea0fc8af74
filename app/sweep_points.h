#pragma once

#include "render/method/settings_table.h"

#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// A setting and the values that it takes in turn.
struct Variation {
    const Setting* setting;
    std::vector<std::string> values; ///< as Setting::text() has them
};

/// "tile=2,3,4". Throws BadInput for an unknown setting, an empty list or a value outside the setting's limits.
Variation parse_variation(std::string_view text);

/// One way to render a scene.
struct SweepPoint {
    RenderSettings settings;
    std::vector<std::string> values; ///< one a variation; empty: it makes no difference here
};

/// Every method with every combination of values, those of the last variation next to each other. Combinations
/// that differ only in what makes no difference (a tile for PT) are one point.
std::vector<SweepPoint> sweep_points(const RenderSettings& base, const std::vector<Method>& methods,
                                     const std::vector<Variation>& variations);

} // namespace tessera
