#pragma once

#include "app/variable.h"

#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// A setting and the values that it takes in turn.
struct Variation {
    Variable variable;
    std::vector<std::string> values; ///< as Variable::text() has them
};

/// "tile=2,3,4". Throws BadInput for an unknown setting, an empty list or a value outside the setting's limits.
Variation parse_variation(std::string_view text);

/// One way to make a picture of a scene.
struct Point {
    PictureSettings settings;
    std::vector<std::string> values; ///< one a variation; empty: it makes no difference here
};

/// Every method with every norm and every combination of values, those of the last variation next to each other.
/// Combinations that differ only in what makes no difference (a tile for PT) are one point.
std::vector<Point> points_of(const PictureSettings& base, const std::vector<Method>& methods,
                             const std::vector<Norm>& norms, const std::vector<Variation>& variations);

/// "pt", "gpr-l2": method and, where there are gradients, reconstruction.
std::string name_of(const Point& point);

} // namespace tessera
