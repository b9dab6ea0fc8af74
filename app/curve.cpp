#include "app/curve.h"

#include "recon/slope.h"

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
    std::vector<glm::dvec2> points;
    for (const Result& result : curve)
        if (is_certain(result))
            points.emplace_back(cpu_seconds_of(result), error_of(result));
    return log_log_slope(points);
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
