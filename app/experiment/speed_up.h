// Statistics of experiments: of samples of one variable, of curves of error against cost, and of the speed-up of
// one curve over another.
#pragma once

#include "app/experiment/result.h"

#include <string>
#include <vector>

namespace tessera {

// Statistics of samples of one variable. The results are NaN for too few samples: the mean needs one, the others
// need two.
double mean_of(const std::vector<double>& values);
double deviation_of(const std::vector<double>& values);
double standard_error_of(const std::vector<double>& values); ///< of the mean

/// Returns the jackknife standard error of an estimate from n samples [Efron and Stein 1981].
/// @param found  n leave-one-out estimates, each without one of the samples
double jackknife_error(const std::vector<double>& found);

/// Returns the two-sided tail probability P(|T| > t) of Student's t with `freedom` > 0 degrees of freedom.
double student_tail(double t, double freedom);

/// Returns the t for which P(|T| > t) is `probability`, in (0, 1]: the inverse of student_tail.
double student_t(double probability, double freedom);

/// Returns the z for which a standard normal variable has P(|Z| > z) = probability: 3 for 0.0027. At most 37,
/// beyond which the probability underflows a double.
double sigmas(double probability);

/// Error against cost: the results of one setup on one scene, in order of increasing time.
using Curve = std::vector<Result>;

/// All curves of one scene, at least one. If results are separated by the kind of machine, all are of one kind.
struct SceneCurves {
    std::string name;          ///< Result::title of all results
    std::vector<Curve> curves; ///< in order of their setups
};

/// Groups results, which must be ordered by scene and setup, into curves. A curve keeps only points that all of
/// its seeds have reached.
std::vector<SceneCurves> curves_by_scene(const std::vector<Result>& results);

/// Returns the exponent b of error ~ (CPU seconds)^b over the significant results (recon/metrics/metrics.h):
/// about -1 for unbiased methods. NaN for fewer than two points.
double slope_of(const Curve& curve);

/// Returns the result after the longest time.
inline const Result& last_of(const Curve& curve) {
    return curve.back();
}

/// Returns the method's curve with the smallest final error; null: the scene has no curve of this method.
const Curve* best_curve(const SceneCurves& scene, Method method);

/// Ratio of the times that two curves take to reach the same error.
struct SpeedUp {
    enum class Kind {
        none,     ///< a curve has no significant error
        measured, ///< both curves cross the error
        at_least, ///< the first point of the faster curve is already below the error
        at_most   ///< the first point of the slower curve is already below the error
    };

    Kind kind = Kind::none;
    double factor = 0;        ///< CPU seconds of the slower curve over those of the faster
    double low = 0, high = 0; ///< 95 % confidence interval of the factor; NaN for one seed, or for a bound
    double error = 0;         ///< the relMSE at which the curves are compared
};

/// Compares two curves at the smallest error that both reach. Times are interpolated linearly in the log-log
/// chart of the curves, after these are made monotone, and never extrapolated. The confidence interval is from
/// the jackknife over seeds of the factor's logarithm [Efron and Stein 1981] and Student's t.
SpeedUp speed_up(const Curve& slower, const Curve& faster);

/// Formats the factor: "12.3 (10.1 to 15.0)", "at least 40" or "out of range".
std::string to_string(const SpeedUp& speed_up);

} // namespace tessera
