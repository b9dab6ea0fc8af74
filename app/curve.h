#pragma once

#include "app/result.h"

#include <string>
#include <vector>

namespace tessera {

/// Error against cost: the results of one point on one scene, by rising time.
using Curve = std::vector<Result>;

/// All curves of one scene, at least one.
struct SceneCurves {
    std::string name;
    std::vector<Curve> curves; ///< in the order of their points
};

/// The results, in the order of their scenes and points, as curves.
std::vector<SceneCurves> curves_by_scene(const std::vector<Result>& results);

/// The exponent b of error ~ (CPU seconds)^b of the certain results (recon/slope.h): -1 for methods without bias.
/// Not a number for fewer than two.
double slope_of(const Curve& curve);

/// The result after the most time.
inline const Result& last_of(const Curve& curve) {
    return curve.back();
}

/// The curve of that method with the least error at its end; null: there is none.
const Curve* best_curve(const SceneCurves& scene, Method method);

} // namespace tessera
