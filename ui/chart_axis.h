#pragma once

#include <string>
#include <vector>

namespace tessera {

/// A place on an axis that is marked.
struct ChartTick {
    double value;
    std::string label; ///< empty: a small mark without one
};

/// One axis of a chart: where values lie on it, and what is marked.
class ChartAxis {
public:
    enum class Scale { linear, log };

    /// Spans `values` with some room at both ends. Left out are values that have no place: those that are not
    /// finite and, on a log scale, not positive. Without any left, it spans 1 to 10.
    static ChartAxis spanning(Scale scale, const std::vector<double>& values);
    /// The places 0, 1, ... are named.
    static ChartAxis of_names(const std::vector<std::string>& names);

    bool has(double value) const; ///< whether it has a place on the scale, within the ends or not
    /// 0 at the low end, 1 at the high end. `value` must have a place.
    double position(double value) const;
    double low() const { return low_; }
    double high() const { return high_; }
    /// Rising, within the ends. At least two are labelled, but of names.
    const std::vector<ChartTick>& ticks() const { return ticks_; }

private:
    ChartAxis(Scale scale, double low, double high) : scale_(scale), low_(low), high_(high) {}

    Scale scale_;
    double low_, high_;
    std::vector<ChartTick> ticks_;
};

/// "0.02", "12", "3·10⁻⁵": to at most four digits.
std::string chart_number(double value);

} // namespace tessera
