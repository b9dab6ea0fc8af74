#pragma once

#include <vector>

namespace tessera {

// Of values of one variable. Not a number where there are too few: none, or, but for the mean, one.
double mean_of(const std::vector<double>& values);
double deviation_of(const std::vector<double>& values);
double standard_error_of(const std::vector<double>& values); ///< of the mean

/// Of what was found from n samples, by what is found when one after the other is left out (jackknife [Efron and
/// Stein 1981]).
/// @param found  n values, in each of which one sample is missing
double jackknife_error(const std::vector<double>& found);

/// The probability that Student's t with that many degrees of freedom (> 0) is beyond +-t.
double student_tail(double t, double freedom);

/// The t beyond +- of which it is with that probability, in (0, 1].
double student_t(double probability, double freedom);

/// How many standard deviations a normal variable is beyond, on either side, with that probability: 0.0027 is 3.
/// At most 37, where doubles end.
double sigmas(double probability);

} // namespace tessera
