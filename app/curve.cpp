#include "app/curve.h"

#include <cmath>
#include <limits>

namespace tessera {

std::vector<SceneCurves> curves_by_scene(const std::vector<Result>& results) {
    std::vector<SceneCurves> scenes;
    const auto goes_on = [](const std::vector<Curve>& curves, const Point& point) {
        return !curves.empty() && name_of(last_of(curves.back()).point) == name_of(point) &&
               last_of(curves.back()).point.values == point.values;
    };
    for (const Result& result : results) {
        if (scenes.empty() || scenes.back().name != result.scene)
            scenes.push_back({result.scene, {}});
        std::vector<Curve>& curves = scenes.back().curves;
        if (!goes_on(curves, result.point))
            curves.emplace_back();
        curves.back().push_back(result);
    }
    return scenes;
}

double slope_of(const Curve& curve) {
    double n = 0, x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
    for (const Result& result : curve) {
        if (!is_certain(result))
            continue;
        const double x = std::log(cpu_seconds_of(result)), y = std::log(error_of(result));
        n += 1;
        x_sum += x;
        y_sum += y;
        xx_sum += x * x;
        xy_sum += x * y;
    }
    const double spread = n * xx_sum - x_sum * x_sum;
    return spread > 1e-9 * n * xx_sum ? (n * xy_sum - x_sum * y_sum) / spread
                                      : std::numeric_limits<double>::quiet_NaN();
}

const Curve* best_curve(const SceneCurves& scene, Method method) {
    const Curve* best = nullptr;
    for (const Curve& curve : scene.curves)
        if (last_of(curve).point.settings.render.method == method &&
            (!best || error_of(last_of(curve)) < error_of(last_of(*best))))
            best = &curve;
    return best;
}

} // namespace tessera
