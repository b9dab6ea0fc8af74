// The statistics of experiments: of a few values, of curves of error against cost, and how much faster one curve
// is than another.
#pragma once

#include "app/experiment/result.h"

#include <string>
#include <vector>

namespace tessera {

// Statistics of values of one variable. They are not a number where there are too few values: none, or, but for
// the mean, one.
double mean_of(const std::vector<double>& values);
double deviation_of(const std::vector<double>& values);
double standard_error_of(const std::vector<double>& values); ///< of the mean

/// The standard error of what was found from n samples, by what is found when one after the other is left out
/// (jackknife [Efron and Stein 1981]).
/// @param found  n values, in each of which one sample is missing
double jackknife_error(const std::vector<double>& found);

/// The probability that Student's t with that many degrees of freedom (> 0) is beyond +-t.
double student_tail(double t, double freedom);

/// The t beyond +-t of which it is with that probability, in (0, 1].
double student_t(double probability, double freedom);

/// How many standard deviations a normal variable is beyond, on either side, with that probability: 0.0027 is 3.
/// At most 37, where doubles end.
double sigmas(double probability);

/// Error against cost: the results of one setup on one scene, by rising time.
using Curve = std::vector<Result>;

/// All curves of one scene, at least one; where results are told apart by the kind of machine, of one kind.
struct SceneCurves {
    std::string name;          ///< Result::title of all
    std::vector<Curve> curves; ///< in the order of their setups
};

/// The results, in the order of their scenes and setups, as curves, which have the points that all of their seeds
/// have reached.
std::vector<SceneCurves> curves_by_scene(const std::vector<Result>& results);

/// The exponent b of error ~ (CPU seconds)^b of the certain results (recon/metrics/metrics.h): -1 for methods
/// without bias. Not a number for fewer than two.
double slope_of(const Curve& curve);

/// The result after the most time.
inline const Result& last_of(const Curve& curve) {
    return curve.back();
}

/// The curve of that method with the least error at its end; null: there is none.
const Curve* best_curve(const SceneCurves& scene, Method method);

/// How many times as long one method takes as another to come to the same error.
struct SpeedUp {
    enum class Kind {
        none,     ///< a curve has no certain error
        measured, ///< both curves pass the error
        at_least, ///< the faster was below the error when it was first measured
        at_most   ///< the slower was
    };

    Kind kind = Kind::none;
    double factor = 0;        ///< CPU seconds of the slower over those of the faster
    double low = 0, high = 0; ///< of the factor, with 95 % confidence; not numbers for one seed, or a bound
    double error = 0;         ///< the relMSE at which the two are compared
};

/// Compares two curves at the least error that both come to; the times for it are interpolated on the lines of the
/// log-log chart, made monotone, and never extrapolated. The confidence is from how the factor changes when one
/// seed after the other is left out (jackknife [Efron and Stein 1981] of its logarithm, Student's t).
SpeedUp speed_up(const Curve& slower, const Curve& faster);

/// The factor in words: "12.3 (10.1 to 15.0)", "at least 40", "out of range".
std::string to_string(const SpeedUp& speed_up);

} // namespace tessera
