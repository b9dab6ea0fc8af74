#include "app/speed_up_table.h"

#include "app/bench_chart.h"

#include <cmath>

#include <fmt/core.h>

namespace tessera {

namespace {

bool is_gpr(const Curve& curve) {
    return last_of(curve).point.settings.render.method == Method::gpr;
}

std::string cell(double value) {
    return std::isfinite(value) ? fmt::format("{:.5g}", value) : "";
}

std::string_view kind_name(SpeedUp::Kind kind) {
    constexpr std::string_view names[] = {"out of range", "measured", "at least", "at most"};
    return names[static_cast<int>(kind)];
}

} // namespace

std::string speed_up_csv(const ExperimentOptions& options, const std::vector<SceneCurves>& scenes) {
    std::string text = "scene,slower,faster,kind,speed_up,low_95,high_95,relmse\n";
    for (const SceneCurves& scene : scenes)
        for (const Curve& slower : scene.curves)
            for (const Curve& faster : scene.curves) {
                if (is_gpr(slower) || !is_gpr(faster))
                    continue;
                const SpeedUp s = speed_up(slower, faster);
                text += fmt::format("{},\"{}\",\"{}\",{},{},{},{},{}\n", scene.name, curve_label(options, slower),
                                    curve_label(options, faster), kind_name(s.kind), cell(s.factor), cell(s.low),
                                    cell(s.high), cell(s.error));
            }
    return text;
}

} // namespace tessera
