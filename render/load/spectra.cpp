#include "render/load/spectra.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

namespace tessera {

namespace {

constexpr int first_nm = 360;
constexpr int last_nm = 830;

/// One lobe of a colour matching function: a Gaussian with two widths.
double lobe(double nm, double height, double center, double width_below, double width_above) {
    const double t = (nm - center) / (nm < center ? width_below : width_above);
    return height * std::exp(-0.5 * t * t);
}

/// The CIE's colour matching functions of 1931 [Wyman, Sloan and Shirley 2013, eq. 4 and table 1].
glm::dvec3 matching_functions(double nm) {
    return {lobe(nm, 1.056, 599.8, 37.9, 31.0) + lobe(nm, 0.362, 442.0, 16.0, 26.7) -
                lobe(nm, 0.065, 501.1, 20.4, 26.2),
            lobe(nm, 0.821, 568.8, 46.9, 40.5) + lobe(nm, 0.286, 530.9, 16.3, 31.1),
            lobe(nm, 1.217, 437.0, 11.8, 36.0) + lobe(nm, 0.681, 459.0, 26.0, 13.8)};
}

/// From X, Y and Z to linear sRGB [IEC 61966-2-1].
glm::dvec3 rgb_of_xyz(glm::dvec3 xyz) {
    const glm::dmat3 columns(3.240970, -0.969244, 0.055630, -1.537383, 1.875968, -0.203977, -0.498611, 0.041555,
                             1.056972);
    return columns * xyz;
}

/// The integral of a spectrum with the matching functions, over that of Y.
template <class Spectrum>
glm::dvec3 linear_rgb(const Spectrum& spectrum) {
    glm::dvec3 xyz(0);
    double y = 0;
    for (int nm = first_nm; nm <= last_nm; ++nm) {
        const glm::dvec3 weights = matching_functions(nm);
        xyz += weights * spectrum(static_cast<double>(nm));
        y += weights.y;
    }
    return rgb_of_xyz(xyz / y);
}

double interpolate(const std::vector<glm::vec2>& samples, double nm) {
    const auto above = std::upper_bound(samples.begin(), samples.end(), nm,
                                        [](double x, glm::vec2 s) { return x < static_cast<double>(s.x); });
    if (above == samples.begin())
        return 0;
    const glm::dvec2 left = *std::prev(above);
    if (above == samples.end())
        return nm == left.x ? left.y : 0;
    const glm::dvec2 right = *above;
    return left.y + (right.y - left.y) * (nm - left.x) / (right.x - left.x);
}

} // namespace

Rgb rgb_of_spectrum(const std::vector<glm::vec2>& samples) {
    if (samples.size() < 2)
        return Rgb(samples.empty() ? 0.0f : samples[0].y);
    static const glm::dvec3 white = linear_rgb([](double) { return 1.0; });
    const glm::dvec3 rgb = linear_rgb([&](double nm) { return interpolate(samples, nm); }) / white;
    return glm::max(Rgb(rgb), Rgb(0));
}

Rgb rgb_of_black_body(double kelvin) {
    // Planck's law: 2 h c^2 / wavelength^5 / (exp(h c / (wavelength k T)) - 1).
    constexpr double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23; // SI
    const auto radiance = [&](double nm) {
        const double m = nm * 1e-9;
        return 1e-9 * 2 * h * c * c / std::pow(m, 5) / std::expm1(h * c / (m * k * kelvin));
    };
    return glm::max(Rgb(linear_rgb(radiance)), Rgb(0));
}

} // namespace tessera
