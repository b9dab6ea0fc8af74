#pragma once

#include "app/curve.h"

namespace tessera {

/// How many times as long one method takes as another to come to the same error.
struct SpeedUp {
    enum class Kind {
        none,     ///< a curve has no certain error
        measured, ///< both curves pass the error
        at_least, ///< the faster was below the error when it was first looked at
        at_most   ///< the slower was
    };

    Kind kind = Kind::none;
    double factor = 0;        ///< CPU seconds of the slower over those of the faster
    double low = 0, high = 0; ///< of the factor, with 95 % confidence; not numbers for one seed, or a bound
    double error = 0;         ///< the relMSE at which the two are compared
};

/// At the least error that both come to; the times for it are interpolated on the lines of the log-log chart, made
/// monotone, and never extrapolated. The confidence is from how the factor changes when one seed after the other
/// is left out (jackknife [Efron and Stein 1981] of its logarithm, Student's t).
SpeedUp speed_up(const Curve& slower, const Curve& faster);

/// "12.3 (10.1 to 15.0)", "at least 40", "out of range".
std::string to_string(const SpeedUp& speed_up);

} // namespace tessera
