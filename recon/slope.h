#pragma once

#include <span>

#include <glm/vec2.hpp>

namespace tessera {

/// The exponent b of y ~ x^b, the slope of a line in a log-log chart, by least squares of the logarithms: -1 for
/// an error that falls as noise does. Left out are points that have no place there. Not a number for fewer than
/// two places along x.
double log_log_slope(std::span<const glm::dvec2> points);

} // namespace tessera
