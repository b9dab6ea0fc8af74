#include "ui/chart.h"

#include <algorithm>

namespace tessera {

ChartAxes axes_of(const ChartPlot& plot) {
    std::vector<double> xs, ys;
    for (const ChartSeries& series : plot.series) {
        for (const ChartPoint& p : series.points) {
            if (!series.is_level)
                xs.push_back(p.x);
            ys.push_back(p.y);
            ys.push_back(p.y + p.error);
            // On a log scale a bar that reaches down to nothing must not squeeze all else.
            ys.push_back(plot.y_scale == ChartAxis::Scale::log ? std::max(p.y - p.error, p.y / 2) : p.y - p.error);
        }
    }
    return {plot.x_names.empty() ? ChartAxis::spanning(plot.x_scale, xs) : ChartAxis::of_names(plot.x_names),
            ChartAxis::spanning(plot.y_scale, ys)};
}

} // namespace tessera
