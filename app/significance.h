#pragma once

namespace tessera {

/// The probability that Student's t with that many degrees of freedom (> 0) is beyond +-t.
double student_tail(double t, double freedom);

/// The t beyond +- of which it is with that probability, in (0, 1].
double student_t(double probability, double freedom);

/// How many standard deviations a normal variable is beyond, on either side, with that probability: 0.0027 is 3.
/// At most 37, where doubles end.
double sigmas(double probability);

} // namespace tessera
