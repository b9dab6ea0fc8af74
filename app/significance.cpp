#include "app/significance.h"

#include <cmath>
#include <limits>

namespace tessera {

namespace {

/// I_x(a, b) by its continued fraction, for x < (a + 1) / (a + b + 2) [Abramowitz and Stegun 1964, 26.5.8],
/// evaluated from the front [Lentz 1976].
double beta_fraction(double x, double a, double b) {
    constexpr double tiny = 1e-300;
    double c = 1, d = 1 / (1 - (a + b) * x / (a + 1)), fraction = d;
    const auto step = [&](double term) {
        d = 1 / (1 + term * d);
        c = 1 + term / c;
        if (std::abs(c) < tiny)
            c = tiny;
        fraction *= c * d;
    };
    for (int m = 1; m < 500; ++m) {
        const double before = fraction;
        step(m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)));
        step(-(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)));
        if (std::abs(fraction - before) < 1e-14 * std::abs(fraction))
            break;
    }
    return fraction;
}

/// The regularised incomplete beta function.
double incomplete_beta(double x, double a, double b) {
    if (x <= 0 || x >= 1)
        return x <= 0 ? 0 : 1;
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
    return x < (a + 1) / (a + b + 2) ? front * beta_fraction(x, a, b) / a
                                     : 1 - front * beta_fraction(1 - x, b, a) / b;
}

/// Where a falling function passes the value, between 0 and `high`.
template <class Function>
double inverse(Function function, double value, double high) {
    double low = 0;
    for (int i = 0; i < 200; ++i) {
        const double middle = (low + high) / 2;
        (function(middle) > value ? low : high) = middle;
    }
    return (low + high) / 2;
}

double count_of(const std::vector<double>& values) {
    return static_cast<double>(values.size());
}

} // namespace

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (double v : values)
        sum += v;
    return sum / count_of(values);
}

double deviation_of(const std::vector<double>& values) {
    if (values.size() < 2)
        return std::numeric_limits<double>::quiet_NaN();
    const double mean = mean_of(values);
    double squares = 0;
    for (double v : values)
        squares += (v - mean) * (v - mean);
    return std::sqrt(squares / (count_of(values) - 1));
}

double standard_error_of(const std::vector<double>& values) {
    return deviation_of(values) / std::sqrt(count_of(values));
}

double jackknife_error(const std::vector<double>& found) {
    return standard_error_of(found) * (count_of(found) - 1);
}

double student_tail(double t, double freedom) {
    return incomplete_beta(freedom / (freedom + t * t), freedom / 2, 0.5); // [Abramowitz and Stegun 1964, 26.7.1]
}

double student_t(double probability, double freedom) {
    return inverse([&](double t) { return student_tail(t, freedom); }, probability, 1e9);
}

double sigmas(double probability) {
    return inverse([](double z) { return std::erfc(z / std::sqrt(2.0)); }, probability, 37);
}

} // namespace tessera
